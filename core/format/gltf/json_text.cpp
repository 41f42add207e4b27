#include "core/format/gltf/json_text.h"

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/watched_loop.h"

namespace coppice::gltf {

namespace {

std::string line_and_column(std::string_view text, size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("line {} column {}", line, before.size() - line_begin + 1);
}

// Where the nesting first goes deeper than the limit.
size_t first_deeper_than(std::string_view text, uint32_t limit) {
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
            if (++depth > limit) return i;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return text.size();
}

// Builds the tree as the parser goes. Json::parse would take the last of two equal keys, knows no depth that
// is too deep (it is iterative itself, but whoever copies or prints the tree later recurses) and cannot be
// stopped.
class TreeBuilder : public nlohmann::json_sax<Json> {
  public:
    TreeBuilder(std::string_view text, const ReadLimits& limits, const Watch& watch)
        : text_(text), limits_(limits), watch_(watch) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(Json::number_integer_t value) override { return add(value); }
    bool number_unsigned(Json::number_unsigned_t value) override { return add(value); }
    bool number_float(Json::number_float_t value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(Json::binary_t&) override { return false; }  // no such thing in text
    bool start_object(size_t) override { return open(Json::object()); }
    bool end_object() override { return close(); }
    bool start_array(size_t) override { return open(Json::array()); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        auto& object = open_.back()->get_ref<Json::object_t&>();
        const auto [member, is_new] = object.try_emplace(std::move(name));
        if (!is_new)  // not require(): it would copy the name of every key
            fail(ErrorCode::asset_malformed, "",
                 fmt::format("the JSON has the key '{}' twice in one object", member->first.substr(0, 100)));
        member_ = &member->second;
        return true;
    }

    bool parse_error(size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        constexpr int number_overflow = 406;
        if (error.id == number_overflow)
            fail(ErrorCode::asset_malformed, line_and_column(text_, position - token.size()),
                 fmt::format("the JSON holds the number {}, which is out of range", token.substr(0, 60)));
        const std::string_view message = error.what();
        const size_t reason = std::min(message.rfind("; expected"), message.size());
        fail(ErrorCode::asset_malformed, line_and_column(text_, position == 0 ? 0 : position - 1),
             fmt::format("the JSON cannot be parsed{}", message.substr(reason)));
    }

    Json tree() { return std::move(root_); }

  private:
    template <typename Value>
    Json& place(Value&& value) {
        watch_.check();
        require(++values_ <= limits_.json_values, ErrorCode::asset_too_large, "",
                "the JSON has more than {} values (limit json_values)", limits_.json_values);
        if (open_.empty()) return root_ = std::forward<Value>(value);
        if (!open_.back()->is_array()) return *member_ = std::forward<Value>(value);
        auto& array = open_.back()->get_ref<Json::array_t&>();
        if (array.empty()) array.reserve(4);  // most are vectors and quaternions
        return array.emplace_back(std::forward<Value>(value));
    }

    template <typename Value>
    bool add(Value&& value) {
        place(std::forward<Value>(value));
        return true;
    }

    bool open(Json container) {
        if (open_.size() == limits_.json_depth)
            fail(ErrorCode::asset_malformed,
                 line_and_column(text_, first_deeper_than(text_, limits_.json_depth)),
                 fmt::format("the JSON is nested deeper than {} levels (limit json_depth)",
                             limits_.json_depth));
        open_.push_back(&place(std::move(container)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    const ReadLimits& limits_;
    const Watch& watch_;
    uint64_t values_ = 0;
    Json root_;
    std::vector<Json*> open_;  // stays valid: what is around an open container gets no further elements
    Json* member_ = nullptr;   // of the innermost object: the one whose key was read last
};

}  // namespace

Json parse_json(ByteView bytes, const ReadLimits& limits, const Watch& watch) {
    const std::string_view text = as_text(bytes);
    require(text.size() <= limits.json_bytes, ErrorCode::asset_too_large, "",
            "the JSON has {} bytes; at most {} are read (limit json_bytes)", text.size(), limits.json_bytes);
    require(!text.starts_with("\xEF\xBB\xBF"), ErrorCode::asset_malformed, "line 1 column 1",
            "the JSON begins with a byte order mark, which glTF forbids");
    TreeBuilder builder(text, limits, watch);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.tree();
}

std::string print_json(const Json& json, const Watch& watch) {
    const auto print = [](const Json& value) {
        return value.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    if (!json.is_object()) return print(json);
    // What a document may have millions of are elements of its arrays.
    WatchedSteps steps(watch);
    std::string text = "{";
    for (const auto& [key, value] : json.items()) {
        text += (text.size() > 1 ? "," : "") + print(key) + ":";
        if (!value.is_array()) {
            text += print(value);
            continue;
        }
        text += "[";
        for (size_t i = 0; i < value.size(); ++i) {
            const std::string element = print(value[i]);
            steps.add(1 + element.size());
            if (i > 0) text += ",";
            text += element;
        }
        text += "]";
    }
    return text + "}";
}

}  // namespace coppice::gltf
