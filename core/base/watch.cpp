#include "core/base/watch.h"

#include "core/base/error.h"

namespace coppice {

void Watch::check() const {
    if (checked) checked();
    if (stop.stop_requested()) fail(ErrorCode::job_cancelled, "", "the job was cancelled");
}

void Watch::report(double fraction) const {
    check();
    if (progress) progress(fraction);
}

Watch Watch::part(double begin, double end) const {
    Watch inner = *this;
    if (progress) {
        inner.progress = [outer = progress, begin, end](double fraction) {
            outer(begin + (end - begin) * fraction);
        };
    }
    return inner;
}

}  // namespace coppice
