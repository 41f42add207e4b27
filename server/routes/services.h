// What routes work with. References; the composition root owns everything.
#pragma once

#include <atomic>
#include <chrono>
#include <stop_token>

#include "server/blobs/blob_store.h"
#include "server/http/limits.h"
#include "server/store/job_store.h"
#include "server/telemetry/metrics.h"

namespace coppice {

struct RouteSettings {
    HttpLimits http = {};
    size_t queue_length = 1000;
    std::chrono::seconds wait{30};      // of a client that does not say
    std::chrono::seconds max_wait{55};  // a minute is where proxies give up
    size_t waiting_clients = 256;       // more are answered with 202 at once
    unsigned slots = 1;
};

struct Services {
    JobStore& store;
    BlobStore& blobs;
    Metrics& metrics;
    RouteSettings settings = {};
    std::stop_token draining = {};  // no new work is taken
    std::stop_token ended = {};     // what has not finished will not any more
    std::atomic<size_t> waiting = 0;
};

// Throws service_draining, queue_full: no new work is taken. The store has the last word on its queue; asked
// before, it spares an upload that would only be refused.
void require_room(const Services& services);

}  // namespace coppice
