#include "core/simplify/registry.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/simplify/attribute_quadric/attribute_quadric.h"
#include "core/simplify/fad.h"
#include "core/simplify/fass.h"
#include "core/simplify/gaea.h"
#include "core/simplify/gaps.h"
#include "core/simplify/garland_heckbert.h"
#include "core/simplify/ias.h"
#include "core/simplify/its.h"
#include "core/simplify/ivdd.h"
#include "core/simplify/openmesh.h"
#include "core/simplify/ss.h"
#include "core/simplify/surface_angle.h"
#include "core/simplify/vt.h"
#include "core/simplify/vtd.h"

namespace coppice {

std::span<const Algorithm> algorithms() {
    static const std::array<Algorithm, 14> list = {attribute_quadric(),
                                                   its(),
                                                   ias(),
                                                   gaps(),
                                                   quadric(),
                                                   gaea(),
                                                   surface_angle(),
                                                   vt(),
                                                   fad(),
                                                   ivdd(),
                                                   ss(),
                                                   vtd(),
                                                   fass(),
                                                   openmesh()};
    return list;
}

const Algorithm& default_algorithm() {
    return find_algorithm("its");
}

const Algorithm& find_algorithm(std::string_view id) {
    const std::span<const Algorithm> list = algorithms();
    const auto found =
        std::find_if(list.begin(), list.end(), [id](const Algorithm& a) { return a.id == id; });
    if (found != list.end()) return *found;
    std::vector<std::string_view> ids;
    for (const Algorithm& a : list) ids.push_back(a.id);
    fail(ErrorCode::option_invalid, "algorithm",
         fmt::format("algorithm \"{}\" does not exist; it may be {}", id, fmt::join(ids, ", ")));
}

}  // namespace coppice
