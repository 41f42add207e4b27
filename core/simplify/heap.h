// A 4-ary min-heap of ids 0..n-1 with changeable keys. Ties by id, so that the order never depends on
// history.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace coppice {

class IndexedHeap {
  public:
    explicit IndexedHeap(size_t id_count) : key_(id_count), place_(id_count, absent) {}

    bool empty() const { return heap_.empty(); }
    size_t size() const { return heap_.size(); }
    bool contains(uint32_t id) const { return place_[id] != absent; }
    double key(uint32_t id) const { return key_[id]; }  // meaningless unless contained
    uint32_t top() const { return heap_.front(); }

    // Inserts the id, or moves it to where its new key belongs.
    void set(uint32_t id, double key) {
        key_[id] = key;
        if (place_[id] == absent) {
            place_[id] = static_cast<uint32_t>(heap_.size());
            heap_.push_back(id);
        }
        sink(rise(place_[id]));
    }

    // Nothing happens when the id is not contained.
    void erase(uint32_t id) {
        const uint32_t hole = std::exchange(place_[id], absent);
        if (hole == absent) return;
        const uint32_t last = heap_.back();
        heap_.pop_back();
        if (last == id) return;
        heap_[hole] = last;
        place_[last] = hole;
        sink(rise(hole));
    }

  private:
    static constexpr uint32_t absent = UINT32_MAX;

    bool before(uint32_t a, uint32_t b) const { return key_[a] != key_[b] ? key_[a] < key_[b] : a < b; }
    void put(uint32_t place, uint32_t id) {
        heap_[place] = id;
        place_[id] = place;
    }

    uint32_t rise(uint32_t place) {
        const uint32_t id = heap_[place];
        while (place > 0) {
            const uint32_t parent = (place - 1) / 4;
            if (!before(id, heap_[parent])) break;
            put(place, heap_[parent]);
            place = parent;
        }
        put(place, id);
        return place;
    }

    void sink(uint32_t place) {
        const uint32_t id = heap_[place];
        const auto count = static_cast<uint32_t>(heap_.size());
        while (4 * place + 1 < count) {
            uint32_t least = 4 * place + 1;
            const uint32_t end = count - least < 4 ? count : least + 4;
            for (uint32_t child = least + 1; child < end; ++child) {
                if (before(heap_[child], heap_[least])) least = child;
            }
            if (!before(heap_[least], id)) break;
            put(place, heap_[least]);
            place = least;
        }
        put(place, id);
    }

    std::vector<double> key_;      // by id
    std::vector<uint32_t> place_;  // by id: index in heap_
    std::vector<uint32_t> heap_;   // ids
};

}  // namespace coppice
