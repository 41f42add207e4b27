#include "core/format/obj/names.h"

#include <fmt/core.h>

#include <map>
#include <set>

namespace coppice {

std::string line_name(std::string_view name, std::string_view fallback) {
    std::string out(name);
    for (char& c : out) {
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    }
    if (out.ends_with('\\')) out.back() = '/';  // would join the next line to it
    const size_t begin = out.find_first_not_of(' ');
    if (begin == out.npos) return std::string(fallback);
    return out.substr(begin, out.find_last_not_of(' ') + 1 - begin);
}

std::vector<std::string> unique_line_names(std::span<const std::string> names, std::string_view fallback) {
    std::vector<std::string> out;
    // Not hashed: a file could be made whose names all have one hash.
    std::set<std::string> taken;
    for (const std::string& name : names) taken.insert(line_name(name, fallback));
    std::map<std::string, int> uses;
    for (const std::string& name : names) {
        std::string unique = line_name(name, fallback);
        int& use = uses[unique];
        if (use++ > 0) {
            const std::string base = unique;
            for (;; ++use) {
                unique = fmt::format("{}-{}", base, use);
                if (taken.insert(unique).second) break;
            }
        }
        out.push_back(std::move(unique));
    }
    return out;
}

}  // namespace coppice
