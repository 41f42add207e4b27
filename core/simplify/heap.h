// A 4-ary min-heap of ids 0..n-1 with changeable keys. Ties by id, so that the order never depends on
// history.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace coppice {

class IndexedHeap {
  public:
    explicit IndexedHeap(size_t id_count) : place_(id_count, absent) {}

    bool empty() const { return heap_.empty(); }
    size_t size() const { return heap_.size(); }
    bool contains(uint32_t id) const { return place_[id] != absent; }
    uint32_t top() const { return heap_.front().id; }
    double top_key() const { return heap_.front().key; }

    // Inserts the id, or moves it to where its new key belongs.
    void set(uint32_t id, double key) {
        if (place_[id] == absent) {
            place_[id] = static_cast<uint32_t>(heap_.size());
            heap_.push_back({key, id});
        }
        const uint32_t place = place_[id];
        heap_[place].key = key;
        sink(rise(place));
    }

    // Nothing happens when the id is not contained.
    void erase(uint32_t id) {
        const uint32_t hole = std::exchange(place_[id], absent);
        if (hole == absent) return;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (last.id == id) return;
        put(hole, last);
        sink(rise(hole));
    }

  private:
    static constexpr uint32_t absent = UINT32_MAX;

    struct Entry {
        double key;
        uint32_t id;

        bool before(const Entry& other) const { return key != other.key ? key < other.key : id < other.id; }
    };

    void put(uint32_t place, const Entry& entry) {
        heap_[place] = entry;
        place_[entry.id] = place;
    }

    uint32_t rise(uint32_t place) {
        const Entry entry = heap_[place];
        while (place > 0) {
            const uint32_t parent = (place - 1) / 4;
            if (!entry.before(heap_[parent])) break;
            put(place, heap_[parent]);
            place = parent;
        }
        put(place, entry);
        return place;
    }

    void sink(uint32_t place) {
        const Entry entry = heap_[place];
        const auto count = static_cast<uint32_t>(heap_.size());
        while (4 * place + 1 < count) {
            uint32_t least = 4 * place + 1;
            const uint32_t end = count - least < 4 ? count : least + 4;
            for (uint32_t child = least + 1; child < end; ++child) {
                if (heap_[child].before(heap_[least])) least = child;
            }
            if (!heap_[least].before(entry)) break;
            put(place, heap_[least]);
            place = least;
        }
        put(place, entry);
    }

    std::vector<Entry> heap_;
    std::vector<uint32_t> place_;  // by id: index in heap_
};

}  // namespace coppice
