#include "server/routes/services.h"

#include "core/base/error.h"

namespace coppice {

void require_room(const Services& services) {
    require(!services.draining.stop_requested(), ErrorCode::service_draining, "",
            "the service is shutting down and takes no new work");
    const size_t queued = services.store.counts().queued;
    require(queued < services.settings.queue_length, ErrorCode::queue_full, "",
            "{} jobs wait already, the limit is {} (queue_length); try again soon", queued,
            services.settings.queue_length);
}

}  // namespace coppice
