#include "server/telemetry/log.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cmath>

namespace coppice {
namespace {

// Bytes of the UTF-8 sequence that the text begins with; 0: there is none.
size_t sequence_bytes(std::string_view text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return 0;
    for (size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    // Overlong forms, surrogates, and what lies beyond Unicode.
    const unsigned char second = byte(1);
    const bool wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                       (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
    return wrong ? 0 : bytes;
}

std::string print_value(const Log::Value& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return quote_json(*text);
    if (const auto* number = std::get_if<int64_t>(&value)) return std::to_string(*number);
    const double number = std::get<double>(value);
    return std::isfinite(number) ? fmt::format("{:.3f}", number) : "null";
}

std::string print_fields(std::string_view event, const Log::Fields& fields) {
    std::string line = "\"event\":" + quote_json(event);
    for (const auto& [name, value] : fields) line += "," + quote_json(name) + ":" + print_value(value);
    return line;
}

}  // namespace

std::string quote_json(std::string_view text) {
    std::string quoted = "\"";
    while (!text.empty()) {
        const size_t bytes = sequence_bytes(text);
        const char c = text[0];
        if (bytes == 0) {
            quoted += "\xef\xbf\xbd";  // U+FFFD
        } else if (c == '"' || c == '\\') {
            quoted += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            quoted += text.substr(0, bytes);
        }
        text.remove_prefix(bytes == 0 ? 1 : bytes);
    }
    return quoted + "\"";
}

Log::Log()
    : Log(std::make_shared<spdlog::logger>("coppice", std::make_shared<spdlog::sinks::stderr_sink_mt>())) {}

Log::Log(std::shared_ptr<spdlog::logger> sink) : sink_(std::move(sink)) {
    sink_->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})", spdlog::pattern_time_type::utc);
}

void Log::info(std::string_view event, const Fields& fields) const {
    sink_->info("{}", print_fields(event, fields));
}

void Log::error(std::string_view event, const Fields& fields) const {
    sink_->error("{}", print_fields(event, fields));
}

}  // namespace coppice
