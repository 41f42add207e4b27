// Text formats, line by line: where we are, for messages, and fast numbers that no locale touches.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace coppice {

// A line and a place in it. Views into the reader's text, valid until its next line.
class Line {
  public:
    Line() = default;
    Line(std::string_view text, uint64_t number)
        : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()), number_(number) {}

    uint64_t number() const { return number_; }  // from 1
    void count_from(uint64_t lines_before) { number_ += lines_before; }
    std::string_view text() const { return {begin_, end_}; }
    std::string where() const { return fmt::format("line {}, column {}", number_, at_ - begin_ + 1); }

    // True when nothing but blanks is left. All that follow skip blanks first.
    bool done() {
        skip_blanks();
        return at_ == end_;
    }
    // The same, or a comment follows.
    bool ended() { return done() || *at_ == '#'; }
    std::string_view word();    // up to the next blank; empty at the end
    std::string_view rest();    // up to the end, without blanks around it
    std::string_view quoted();  // a word, or "..." with the escapes \" and \\ left in; see unquoted()

    // Numbers. what: for the message, e.g. "the x of a vertex". number() may give nan and infinity.
    double number(std::string_view what);
    int64_t integer(std::string_view what);

    char peek() const { return at_ < end_ ? *at_ : '\0'; }
    bool accept(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    bool at_blank() const { return at_ == end_ || *at_ == ' ' || *at_ == '\t'; }
    void skip_blanks() {
        while (at_ < end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
    }

    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
        coppice::fail(ErrorCode::asset_malformed, where(), fmt::format(message, std::forward<Args>(args)...));
    }

  private:
    std::string_view unread_word() const;

    const char* begin_ = nullptr;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    uint64_t number_ = 0;
};

// Lines end with \n, \r\n, or \r where the text has no \n at all. A byte order mark is skipped.
class LineReader {
  public:
    // continuations: a backslash at the end of a line joins the next to it, with a blank between.
    explicit LineReader(std::string_view text, bool continuations = false);

    bool next(Line& line);                 // false at the end
    size_t offset() const { return at_; }  // of the line after the last one given

  private:
    std::string_view raw_line();

    std::string_view text_;
    bool continuations_;
    char terminator_;
    size_t at_ = 0;
    uint64_t number_ = 0;
    std::string joined_;
};

}  // namespace coppice
