#include "core/format/gltf/json_text.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/base/error.h"

namespace coppice::gltf {

namespace {

std::string line_and_column(std::string_view text, size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("line {} column {}", line, before.size() - line_begin + 1);
}

// "... number overflow parsing '1e999'" -> 1e999: the parser gives no position, but the number as it was
// written.
std::string quoted(std::string_view message) {
    const size_t begin = std::min(message.find('\''), message.size() - 1) + 1;
    return std::string(message.substr(begin, message.rfind('\'') - begin));
}

// The nesting depth is counted before parsing: the parser itself is iterative, but whoever copies or prints
// the tree later recurses.
void check_depth(std::string_view text, uint32_t limit) {
    uint32_t depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            // Not require(): counting lines for each bracket would take quadratic time.
            if (++depth <= limit) continue;
            fail(ErrorCode::asset_malformed, line_and_column(text, i),
                 fmt::format("the JSON is nested deeper than {} levels (limit json_depth)", limit));
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
}

// Refuses the second key of a name in one object. A pass of its own: a callback of Json::parse would look at
// all children of an object or array for each that ends, which is quadratic.
class DuplicateKeys : public nlohmann::json_sax<Json> {
  public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(Json::number_integer_t) override { return true; }
    bool number_unsigned(Json::number_unsigned_t) override { return true; }
    bool number_float(Json::number_float_t, const std::string&) override { return true; }
    bool string(std::string&) override { return true; }
    bool binary(Json::binary_t&) override { return true; }
    bool start_array(size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;  // Json::parse says it
    }
    bool start_object(size_t) override {
        keys_.emplace_back();
        return true;
    }
    bool end_object() override {
        keys_.pop_back();
        return true;
    }
    bool key(std::string& name) override {
        require(keys_.back().insert(name).second, ErrorCode::asset_malformed, "",
                "the JSON has the key '{}' twice in one object", name.substr(0, 100));
        return true;
    }

  private:
    std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json(ByteView bytes, const ReadLimits& limits) {
    const std::string_view text = as_text(bytes);
    require(text.size() <= limits.json_bytes, ErrorCode::asset_too_large, "",
            "the JSON has {} bytes; at most {} are read (limit json_bytes)", text.size(), limits.json_bytes);
    require(!text.starts_with("\xEF\xBB\xBF"), ErrorCode::asset_malformed, "line 1 column 1",
            "the JSON begins with a byte order mark, which glTF forbids");
    check_depth(text, limits.json_depth);
    try {
        DuplicateKeys duplicates;
        Json::sax_parse(text.begin(), text.end(), &duplicates);
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        const std::string_view message = error.what();
        const size_t colon = message.rfind("; expected");
        fail(ErrorCode::asset_malformed, line_and_column(text, error.byte == 0 ? 0 : error.byte - 1),
             fmt::format("the JSON cannot be parsed{}", colon == std::string_view::npos
                                                            ? std::string()
                                                            : std::string(message.substr(colon))));
    } catch (const Json::exception& error) {
        const std::string number = quoted(error.what());
        fail(ErrorCode::asset_malformed, line_and_column(text, text.find(number)),
             fmt::format("the JSON holds the number {}, which is out of range", number.substr(0, 60)));
    }
}

std::string print_json(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace coppice::gltf
