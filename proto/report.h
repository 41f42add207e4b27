// The report, the inspection and the list of algorithms as JSON.
#pragma once

#include <string>

#include "core/optimize/inspect.h"
#include "core/optimize/report.h"

namespace coppice {

std::string print_report(const Report& report);
std::string print_inspection(const Inspection& inspection);
std::string print_algorithms();  // {"algorithms": [...]}, from the registry

}  // namespace coppice
