#include "core/compare/options.h"

#include "core/base/error.h"

namespace coppice {

void validate(const CompareOptions& options) {
    require(options.samples >= 1 && options.samples <= 10'000, ErrorCode::option_invalid, "samples",
            "samples is {}; it takes a number from 1 to 10000, of samples for each triangle",
            options.samples);
}

}  // namespace coppice
