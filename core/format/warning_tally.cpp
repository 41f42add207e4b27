#include "core/format/warning_tally.h"

#include <fmt/core.h>

namespace coppice {

void WarningTally::note(std::string_view code, std::string_view message, std::string_view where) {
    for (Entry& entry : entries_) {
        if (entry.warning.code == code && entry.warning.message == message) {
            ++entry.count;
            return;
        }
    }
    // Messages may quote the input: a hostile one would have us compare each with all.
    if (entries_.size() == most_entries) {
        ++left_out_;
        return;
    }
    entries_.push_back({{std::string(code), std::string(message), std::string(where)}, 1});
}

void WarningTally::move_to(std::vector<Warning>& warnings) {
    for (Entry& entry : entries_) {
        if (entry.count > 1) entry.warning.message += fmt::format(" ({} times, first here)", entry.count);
        warnings.push_back(std::move(entry.warning));
    }
    if (left_out_ > 0) {
        warnings.push_back({"warnings.more", fmt::format("{} further warnings are not listed", left_out_)});
    }
    entries_.clear();
    left_out_ = 0;
}

}  // namespace coppice
