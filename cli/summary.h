// What the commands say of an asset.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/optimize/report.h"

namespace coppice {

std::string print_meshes(const AssetSummary& summary);     // "3 unique meshes, 14 instances"
std::string print_triangles(const AssetSummary& summary);  // "1,200 stored, 5,600 drawn"
void print_warnings(const std::vector<Warning>& warnings, std::ostream& err);  // a line each

}  // namespace coppice
