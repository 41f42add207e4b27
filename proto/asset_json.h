// What several documents say of an asset. For the .cpp files of proto/ only.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/optimize/report.h"

namespace coppice {

nlohmann::ordered_json to_json(const AssetSummary& summary);
nlohmann::ordered_json to_json(const Warning& warning);

}  // namespace coppice
