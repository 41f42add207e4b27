#include "core/format/iobj/directive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace coppice {

namespace {

constexpr std::string_view version_word = "#@iobj", instance_word = "#@instance";
constexpr size_t matrix_numbers = 16;

std::string unquoted(std::string_view quoted) {
    if (!quoted.starts_with('"')) return std::string(quoted);
    std::string name;
    for (size_t i = 1; i + 1 < quoted.size(); ++i) {
        if (quoted[i] == '\\' && i + 2 < quoted.size()) ++i;
        name += quoted[i];
    }
    return name;
}

std::string name_of(Line& line, std::string_view what) {
    const bool missing = line.done();
    if (missing) line.fail("{} is missing; a line is #@instance OBJECT NAME and 16 numbers", what);
    return unquoted(line.quoted());
}

std::array<double, matrix_numbers> matrix_of(Line& line) {
    std::array<double, matrix_numbers> matrix{};
    for (size_t i = 0; i < matrix_numbers; ++i) {
        if (line.done()) line.fail("#@instance has {} numbers; it takes exactly 16", i);
        matrix[i] = line.number(fmt::format("m{}{}", i / 4, i % 4));
        if (!std::isfinite(matrix[i])) line.fail("m{}{} is not finite", i / 4, i % 4);
    }
    if (!line.done()) line.fail("#@instance has more than 16 numbers");
    return matrix;
}

}  // namespace

bool is_iobj(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text.starts_with(version_word);
}

void parse_version_directive(Line line) {
    if (line.word() != version_word) line.fail("an instanced OBJ begins with \"#@iobj 1.0\"");
    const std::string_view version = line.word();
    const bool known = version == "1" || (version.starts_with("1.") && version.size() > 2 &&
                                          version.find_first_not_of("0123456789", 2) == version.npos);
    if (!known) line.fail("#@iobj version \"{}\" is not read; version 1.0 is", version);
    if (!line.done()) line.fail("nothing may follow the version of #@iobj");
}

InstanceDirective parse_instance_directive(Line line) {
    const std::string_view word = line.word();
    if (word != instance_word) {
        line.fail("directive \"{}\" is unknown; version 1.0 has #@iobj, in the first line, and #@instance",
                  word);
    }
    InstanceDirective instance;
    instance.line = line.number();
    instance.object = name_of(line, "OBJECT");
    instance.name = name_of(line, "NAME");
    const auto matrix = matrix_of(line);
    if (matrix[12] != 0 || matrix[13] != 0 || matrix[14] != 0 || matrix[15] != 1) {
        line.fail("the last row of the matrix is {} {} {} {}; it must be 0 0 0 1", matrix[12], matrix[13],
                  matrix[14], matrix[15]);
    }
    std::copy_n(matrix.begin(), instance.placement.m.size(), instance.placement.m.begin());
    const double volume = determinant(instance.placement);
    if (volume == 0 || !std::isfinite(volume)) line.fail("the matrix is singular: it flattens the object");
    return instance;
}

std::string print_instance_directive(const InstanceDirective& instance) {
    std::string line =
        fmt::format("{} {} {}", instance_word, quoted_name(instance.object), quoted_name(instance.name));
    for (size_t i = 0; i < instance.placement.m.size(); ++i) {
        const double value = instance.placement.m[i];
        fmt::format_to(std::back_inserter(line), "{}{}", i % 4 == 0 && i > 0 ? "  " : " ",
                       value == 0 ? 0.0 : value);
    }
    return line + "  0 0 0 1";
}

std::string quoted_name(std::string_view name) {
    if (!name.empty() && name.find_first_of(" \t\"\\") == name.npos) return std::string(name);
    std::string out = "\"";
    for (const char c : name) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

}  // namespace coppice
