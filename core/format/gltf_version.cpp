#include "core/format/gltf_version.h"

#include <cstdint>

namespace coppice {

namespace {

// Walks JSON and keeps the depth and the last string. Escapes are left in: the names that count have none.
class Scanner {
  public:
    explicit Scanner(std::string_view json) : json_(json) {}

    std::string version() {
        std::string_view key;   // the last key of the object at hand
        bool in_asset = false;  // between the braces of the root's "asset"
        while (at_ < json_.size()) {
            const char c = json_[at_++];
            if (c == '"') {
                const std::string_view text = string();
                if (next_is_colon()) {
                    key = text;
                } else if (in_asset && depth_ == 2 && key == "version") {
                    return std::string(text);
                }
            } else if (c == '{' || c == '[') {
                ++depth_;
                if (c == '{' && depth_ == 2 && key == "asset") in_asset = true;
            } else if (c == '}' || c == ']') {
                if (--depth_ <= 0) break;
                if (depth_ == 1) in_asset = false;
            }
        }
        return {};
    }

  private:
    std::string_view string() {
        const size_t begin = at_;
        while (at_ < json_.size() && json_[at_] != '"') at_ += json_[at_] == '\\' ? 2 : 1;
        const std::string_view text = json_.substr(begin, at_ - begin);
        ++at_;
        return text;
    }

    bool next_is_colon() const {
        const size_t next = json_.find_first_not_of(" \t\r\n", at_);
        return next != json_.npos && json_[next] == ':';
    }

    std::string_view json_;
    size_t at_ = 0;
    int64_t depth_ = 0;
};

}  // namespace

std::string gltf_version(std::string_view json) {
    return Scanner(json).version();
}

}  // namespace coppice
