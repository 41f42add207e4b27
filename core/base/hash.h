// SHA-256, the name of every blob.
#pragma once

#include <memory>
#include <string>

#include "core/base/bytes.h"

namespace coppice {

// Streaming SHA-256. Movable; not for use by two threads at once.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;

    void update(ByteView bytes);
    std::string finish_hex();  // 64 lower-case hex digits; call once

  private:
    struct State;
    std::unique_ptr<State> state_;
};

std::string sha256_hex(ByteView bytes);

}  // namespace coppice
