#include "tests/core/format/trip_wire.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <csignal>
#include <cstdint>
#include <utility>

namespace coppice::test {
namespace {

std::array<TripWire*, 2> wires{};
struct sigaction before {};  // the first wire

uintptr_t page_bytes() {
    static const auto bytes = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
    return bytes;
}

void trip(int /*signal*/, siginfo_t* info, void* /*context*/) {
    for (TripWire* const wire : wires) {
        if (wire != nullptr && wire->is_at(info->si_addr)) return wire->touch();
    }
    ::sigaction(SIGSEGV, &before, nullptr);  // not ours: it happens again, and is told as ever
}

bool none_is_set() {
    return wires == std::array<TripWire*, 2>{};
}

}  // namespace

TripWire::TripWire(ByteView bytes, size_t offset, std::function<void()> on_touch)
    : on_touch_(std::move(on_touch)) {
    const auto address = reinterpret_cast<uintptr_t>(bytes.data()) + offset;
    page_ = reinterpret_cast<std::byte*>((address + page_bytes() - 1) / page_bytes() * page_bytes());
    assert(page_ + page_bytes() <= bytes.data() + bytes.size());
    if (none_is_set()) {
        struct sigaction ours {};
        ours.sa_sigaction = trip;
        ours.sa_flags = SA_SIGINFO;
        ::sigaction(SIGSEGV, &ours, &before);
    }
    (wires[0] == nullptr ? wires[0] : wires[1]) = this;
    ::mprotect(page_, page_bytes(), PROT_NONE);
}

TripWire::~TripWire() {
    ::mprotect(page_, page_bytes(), PROT_READ | PROT_WRITE);
    (wires[0] == this ? wires[0] : wires[1]) = nullptr;
    if (none_is_set()) ::sigaction(SIGSEGV, &before, nullptr);
}

bool TripWire::is_at(const void* address) const {
    return address >= page_ && address < page_ + page_bytes();
}

void TripWire::touch() {
    ::mprotect(page_, page_bytes(), PROT_READ | PROT_WRITE);
    touched_ = true;
    if (on_touch_) on_touch_();
}

}  // namespace coppice::test
