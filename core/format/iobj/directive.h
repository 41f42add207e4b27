// The lines that make an OBJ an instanced one: "#@iobj 1.0" and "#@instance OBJECT NAME m00 ... m33".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/format/line_reader.h"
#include "core/scene/transform.h"

namespace coppice {

struct InstanceDirective {
    std::string object;
    std::string name;
    Transform placement = {};
    uint64_t line = 0;
};

// True when the text begins with "#@iobj" (after a byte order mark, if any).
bool is_iobj(std::string_view text);

// Checks "#@iobj 1.0". Throws asset_malformed naming the line for another major version.
void parse_version_directive(Line line);

// A line that begins with "#@instance". Throws asset_malformed naming line and column: another directive, not
// exactly 16 finite numbers, last row other than 0 0 0 1, singular.
InstanceDirective parse_instance_directive(Line line);

// The line for it, without its end. Numbers are the shortest that read back the same.
std::string print_instance_directive(const InstanceDirective& instance);

// A name as directives have it: quoted where it is empty or holds blanks or quotes.
std::string quoted_name(std::string_view name);

}  // namespace coppice
