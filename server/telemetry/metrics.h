// Figures for Prometheus, in its text format.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace coppice {

// Thread-safe.
class Metrics {
  public:
    Metrics();
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    // route: the pattern, so that there are only so many; empty where none matched.
    void request_done(const std::string& method, const std::string& route, int status, double seconds,
                      uint64_t bytes_in, uint64_t bytes_out);
    void job_done(const std::string& kind, const std::string& status, double seconds);
    void stage_done(const std::string& stage, double seconds);
    void asset_optimized(uint64_t bytes_in, uint64_t bytes_out, uint64_t triangles_in,
                         uint64_t triangles_out);

    struct Now {
        size_t queued = 0;
        size_t running = 0;
        size_t finished = 0;
        size_t slots = 0;
    };
    std::string print(const Now& now);

  private:
    struct Families;
    std::unique_ptr<Families> families_;
};

}  // namespace coppice
