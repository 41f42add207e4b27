#include "core/format/line_reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace coppice {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Decimal digits before they become a number: mantissa * 10^exponent.
struct Decimal {
    uint64_t mantissa = 0;
    int digits = 0;
    int exponent = 0;
};

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> exact_powers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int most_digits = 19;  // that cannot overflow 64 bits

// Reads digits, and returns where they end.
const char* scan_digits(const char* at, const char* end, Decimal& number) {
    for (; at < end && is_digit(*at); ++at) {
        number.mantissa = number.mantissa * 10 + static_cast<uint64_t>(*at - '0');
        ++number.digits;
    }
    return at;
}

// "1.25e-3" where the result is exact with one multiplication or division (Clinger 1990); else null, and
// from_chars takes over. A sign is not read here.
const char* fast_double(const char* at, const char* end, double& value) {
    Decimal number;
    at = scan_digits(at, end, number);
    if (at < end && *at == '.') {
        const char* fraction = at + 1;
        at = scan_digits(fraction, end, number);
        number.exponent = -static_cast<int>(std::min<std::ptrdiff_t>(at - fraction, 1000));
    }
    if (number.digits == 0 || number.digits > most_digits) return nullptr;
    if (at < end && (*at == 'e' || *at == 'E')) {
        const char* power = at + 1;
        const bool negative = power < end && *power == '-';
        if (power < end && (*power == '-' || *power == '+')) ++power;
        Decimal exponent;
        at = scan_digits(power, end, exponent);
        if (exponent.digits == 0 || exponent.digits > 4) return nullptr;
        number.exponent += static_cast<int>(negative ? -static_cast<int64_t>(exponent.mantissa)
                                                     : static_cast<int64_t>(exponent.mantissa));
    }
    if (number.mantissa > (uint64_t{1} << 53) || std::abs(number.exponent) > 22) return nullptr;
    const auto mantissa = static_cast<double>(number.mantissa);
    const double power = exact_powers[static_cast<size_t>(std::abs(number.exponent))];
    value = number.exponent < 0 ? mantissa / power : mantissa * power;
    return at;
}

// Also nan, inf, more digits and larger exponents. Too large is infinite, too small is 0. Null when it is no
// number.
const char* any_double(const char* at, const char* end, double& value) {
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error == std::errc::invalid_argument) return nullptr;
    if (error == std::errc::result_out_of_range) {
        const std::string_view digits(at, static_cast<size_t>(stop - at));
        const bool tiny = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos ||
                          digits.find_first_not_of("0.") > digits.find('.');
        value = tiny ? 0 : std::numeric_limits<double>::infinity();
    }
    return stop;
}

}  // namespace

std::string_view Line::unread_word() const {
    const char* stop = at_;
    while (stop < end_ && *stop != ' ' && *stop != '\t') ++stop;
    return {at_, stop};
}

std::string_view Line::word() {
    skip_blanks();
    const std::string_view found = unread_word();
    at_ += found.size();
    return found;
}

std::string_view Line::rest() {
    skip_blanks();
    const char* stop = end_;
    while (stop > at_ && (stop[-1] == ' ' || stop[-1] == '\t')) --stop;
    const std::string_view found(at_, stop);
    at_ = end_;
    return found;
}

std::string_view Line::quoted() {
    skip_blanks();
    if (peek() != '"') return word();
    const char* opening = at_++;
    while (at_ < end_ && *at_ != '"') at_ += *at_ == '\\' && at_ + 1 < end_ ? 2 : 1;
    if (!accept('"')) fail("the quoted name {} does not end", std::string_view(opening, end_));
    if (!at_blank()) fail("a blank must follow the quoted name {}", std::string_view(opening, at_));
    return {opening, at_};
}

double Line::number(std::string_view what) {
    skip_blanks();
    const char* digits = at_;
    const bool negative = digits < end_ && *digits == '-';
    if (digits < end_ && (*digits == '-' || *digits == '+')) ++digits;
    double value = 0;
    const char* stop = fast_double(digits, end_, value);
    const bool second_sign = digits < end_ && (*digits == '-' || *digits == '+');
    if (!stop && !second_sign) stop = any_double(digits, end_, value);
    // "3.1+e2", as some write 3.1e+2.
    if (stop && end_ - stop > 2 && (*stop == '+' || *stop == '-') && (stop[1] == 'e' || stop[1] == 'E')) {
        double power = 0;
        const char* after = fast_double(stop + 2, end_, power);
        if (after) value *= std::pow(10.0, *stop == '-' ? -power : power);
        stop = after;
    }
    const bool ends = stop && (stop == end_ || *stop == ' ' || *stop == '\t');
    if (!ends) {
        if (at_ == end_) fail("{} is missing", what);
        fail("{} is \"{}\", which is not a number", what, unread_word().substr(0, 40));
    }
    at_ = stop;
    return negative ? -value : value;
}

int64_t Line::integer(std::string_view what) {
    skip_blanks();
    const char* digits = at_ < end_ && *at_ == '+' ? at_ + 1 : at_;
    int64_t value = 0;
    const auto [stop, error] = std::from_chars(digits, end_, value);
    if (error != std::errc()) {
        if (at_ == end_) fail("{} is missing", what);
        fail("{} is \"{}\", which is not an integer of 64 bits", what, unread_word().substr(0, 40));
    }
    at_ = stop;
    return value;
}

LineReader::LineReader(std::string_view text, bool continuations)
    : text_(text), continuations_(continuations), terminator_('\n') {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
    if (text_.find('\n') == text_.npos) terminator_ = '\r';
}

std::string_view LineReader::raw_line() {
    const size_t end = std::min(text_.find(terminator_, at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

bool LineReader::next(Line& line) {
    if (at_ >= text_.size()) return false;
    std::string_view text = raw_line();
    const uint64_t number = number_;
    if (continuations_ && text.ends_with('\\')) {
        joined_.clear();
        while (text.ends_with('\\') && at_ < text_.size()) {
            joined_.append(text.substr(0, text.size() - 1)).push_back(' ');
            text = raw_line();
        }
        if (text.ends_with('\\')) text.remove_suffix(1);
        text = joined_.append(text);
    }
    line = Line(text, number);
    return true;
}

}  // namespace coppice
