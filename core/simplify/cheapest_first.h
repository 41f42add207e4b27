// The order of collapses that takes the cheapest edge first.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/collapse_rules.h"
#include "core/simplify/heap.h"

namespace coppice {

// An edge as one of its ends, its owner, queues with it. Ordered by error, then by the other end.
struct Candidate {
    uint32_t other = no_index;  // none
    double error = std::numeric_limits<double>::infinity();

    bool exists() const { return other != no_index; }
    friend bool operator<(const Candidate& a, const Candidate& b) {
        return a.error != b.error ? a.error < b.error : a.other < b.other;
    }
};

struct Collapsed {
    uint32_t removed = no_index, kept = no_index;
};

// Each vertex queues with the cheapest edge that it owns. Where that is refused it goes on to the next, until
// its surroundings change.
//
// Work is what collapses (EdgeCollapse) and has
//   - mesh(), done(), fraction(), forget_refusals();
//   - Candidate next_candidate(owner, after): its cheapest edge; with a candidate given, that comes after it;
//   - optional<double> cost(owner, other): of one edge; none where it is not allowed, or the other's;
//   - optional<Collapsed> try_collapse(owner, other);
//   - void ring(vertex, vector& out): its neighbours, each once.
template <typename Work>
class CheapestFirst {
  public:
    CheapestFirst(Work& work, const Watch& watch)
        : work_(work),
          mesh_(work.mesh()),
          watch_(watch),
          heap_(mesh_.vertex_count()),
          candidates_(mesh_.vertex_count()),
          skipped_(mesh_.vertex_count()) {}

    // Until the work is done, or nothing is left. A collapse can make possible what was refused two rings
    // away. So there is another round, while they pay.
    void run() {
        uint64_t collapses = 0;
        do {
            queue_all();
            collapses = drain();
        } while (!work_.done() && collapses > mesh_.live_vertices() / 1000);
    }

    // For who drives several at once, or stops in between.
    void queue_all() {
        work_.forget_refusals();
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            if (v % 1024 == 0) watch_.check();
            if (mesh_.is_live_vertex(v)) queue(v, work_.next_candidate(v, {}));
        }
    }
    // One round: until the work is done or nothing is left in the queue. Returns how often it collapsed.
    uint64_t drain() {
        uint64_t collapses = 0;
        for (uint64_t step = 0; !empty() && !work_.done(); ++step) {
            if (step % 16 == 0) watch_.check();
            if (step % 512 == 0) watch_.report(work_.fraction());
            collapses += try_cheapest();
        }
        return collapses;
    }
    // For a vertex whose surroundings have changed otherwise than by a collapse.
    void queue_again(uint32_t vertex) { queue(vertex, work_.next_candidate(vertex, {})); }
    bool empty() const { return heap_.empty(); }
    double cheapest() const { return heap_.top_key(); }

    // True when it collapsed; else the edge is out of the queue until its surroundings change.
    bool try_cheapest() {
        const uint32_t owner = heap_.top();
        const Candidate candidate = candidates_[owner];
        if (is_hub(candidate.other) && has_become_dearer(owner, candidate)) return false;
        const std::optional<Collapsed> collapsed = collapse(owner, candidate.other);
        if (!collapsed) {
            queue(owner, work_.next_candidate(owner, candidate));
            skipped_[owner] = true;
            return false;
        }
        const auto [removed, kept] = *collapsed;
        heap_.erase(removed);
        for (const uint32_t v : ring_) {
            if (mesh_.is_live_vertex(v) && v != kept) rank_again(v, removed, kept);
        }
        if (mesh_.is_live_vertex(kept)) queue(kept, work_.next_candidate(kept, {}));
        return true;
    }

  private:
    // Leaves in ring_ the vertices whose edges have another price now. Around a vertex with very many
    // triangles only the changed side is ranked anew at once, the rest when its turn comes.
    std::optional<Collapsed> collapse(uint32_t owner, uint32_t other) {
        const bool owner_is_hub = is_hub(owner);
        if (!owner_is_hub) work_.ring(owner, ring_);
        const std::optional<Collapsed> collapsed = work_.try_collapse(owner, other);
        if (!collapsed) return {};
        if (!is_hub(collapsed->kept)) {
            work_.ring(collapsed->kept, ring_);
        } else if (owner_is_hub) {
            ring_.clear();
        }
        return collapsed;
    }

    // After a collapse beside this vertex: only the way to the vertex that stayed has another price now.
    void rank_again(uint32_t vertex, uint32_t removed, uint32_t kept) {
        const Candidate& best = candidates_[vertex];
        if (skipped_[vertex] || !best.exists() || best.other == kept || best.other == removed) {
            queue(vertex, work_.next_candidate(vertex, {}));
            return;
        }
        const std::optional<double> error = work_.cost(vertex, kept);
        if (error && Candidate{kept, *error} < best) queue(vertex, {kept, *error});
    }

    bool is_hub(uint32_t vertex) const { return mesh_.valence(vertex) > largest_removable_valence; }

    bool has_become_dearer(uint32_t owner, const Candidate& candidate) {
        const std::optional<double> now = work_.cost(owner, candidate.other);
        if (now && *now <= candidate.error) return false;
        queue(owner, now ? Candidate{candidate.other, *now} : work_.next_candidate(owner, candidate));
        skipped_[owner] = true;
        return true;
    }

    void queue(uint32_t vertex, const Candidate& candidate) {
        candidates_[vertex] = candidate;
        skipped_[vertex] = false;
        if (candidate.exists()) {
            heap_.set(vertex, candidate.error);
        } else {
            heap_.erase(vertex);
        }
    }

    Work& work_;
    const CollapseMesh& mesh_;
    const Watch& watch_;
    IndexedHeap heap_;
    std::vector<Candidate> candidates_;  // per vertex: what it is queued with
    std::vector<bool> skipped_;          // per vertex: whether cheaper candidates were refused
    std::vector<uint32_t> ring_;
};

}  // namespace coppice
