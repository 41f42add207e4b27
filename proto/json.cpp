#include "proto/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "core/base/error.h"

namespace coppice {
namespace {

using Event = nlohmann::json::parse_event_t;

// "line 2, column 7" of a byte offset that counts from 1.
std::string place(std::string_view text, size_t byte) {
    const std::string_view before = text.substr(0, byte == 0 ? 0 : std::min(byte - 1, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t last_newline = before.rfind('\n');
    const size_t column = before.size() - (last_newline == std::string_view::npos ? 0 : last_newline + 1) + 1;
    return fmt::format("line {}, column {}", line, column);
}

// The sentence at the end of nlohmann's message, without its own prefix and numbers.
std::string reason(std::string_view what) {
    const size_t dash = what.rfind(" - ");
    if (dash != std::string_view::npos) return std::string(what.substr(dash + 3));
    const size_t bracket = what.find("] ");
    return std::string(bracket == std::string_view::npos ? what : what.substr(bracket + 2));
}

// What the parser's callback checks while it goes down and up again.
class Nesting {
  public:
    Nesting(const JsonLimits& limits, std::string_view what) : limits_(limits), what_(what) {}

    void open() {
        keys_.emplace_back();
        require(keys_.size() <= limits_.depth, ErrorCode::request_malformed, "",
                "{} is nested deeper than {} levels", what_, limits_.depth);
    }
    void close() { keys_.pop_back(); }
    void key(const std::string& key) {
        require(keys_.back().insert(key).second, ErrorCode::option_conflict, key,
                "{} is given twice; give it once", key);
    }

  private:
    const JsonLimits& limits_;
    std::string_view what_;
    std::vector<std::set<std::string>> keys_;
};

}  // namespace

nlohmann::json parse_json(std::string_view text, const JsonLimits& limits, std::string_view what) {
    require(text.size() <= limits.bytes, ErrorCode::request_malformed, "",
            "{} is {} bytes long; it may be {}", what, text.size(), limits.bytes);
    Nesting nesting(limits, what);
    const auto check = [&nesting](int, Event event, nlohmann::json& parsed) {
        switch (event) {
            case Event::object_start:
            case Event::array_start:
                nesting.open();
                break;
            case Event::object_end:
            case Event::array_end:
                nesting.close();
                break;
            case Event::key:
                nesting.key(parsed.get_ref<const std::string&>());
                break;
            case Event::value:
                break;
        }
        return true;
    };
    try {
        return nlohmann::json::parse(text, check);
    } catch (const nlohmann::json::parse_error& error) {
        const std::string where = place(text, error.byte);
        fail(ErrorCode::request_malformed, where,
             fmt::format("{} is not valid JSON: {} (at {})", what, reason(error.what()), where));
    } catch (const nlohmann::json::exception& error) {
        fail(ErrorCode::request_malformed, "",
             fmt::format("{} is not valid JSON: {}", what, reason(error.what())));
    }
}

std::string print_json(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string print_json(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace coppice
