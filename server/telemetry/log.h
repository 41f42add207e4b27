// One JSON line an event, on standard error. What clients send can never break a line or forge another.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace spdlog {
class logger;
}

namespace coppice {

// A JSON string with its quotes; control characters are escaped, bytes that are not UTF-8 replaced.
std::string quote_json(std::string_view text);

// Thread-safe.
class Log {
  public:
    using Value = std::variant<std::string, int64_t, double>;
    using Fields = std::vector<std::pair<std::string_view, Value>>;

    Log();                                               // to standard error
    explicit Log(std::shared_ptr<spdlog::logger> sink);  // for tests

    void info(std::string_view event, const Fields& fields = {}) const;
    void error(std::string_view event, const Fields& fields = {}) const;

  private:
    std::shared_ptr<spdlog::logger> sink_;
};

}  // namespace coppice
