// Random numbers that are the same with every compiler and library, which std's distributions are not.
#pragma once

#include <cstdint>

namespace coppice {

// SplitMix64 (Steele, Lea and Flood 2014).
// Draw into a variable of its own: the order of evaluation inside an expression is the compiler's choice.
class Random {
  public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // [0, 1)
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(uniform() * count); }

  private:
    uint64_t state_;
};

}  // namespace coppice
