#include <algorithm>
#include <vector>

#include "core/simplify/heap.h"
#include "core/simplify/its_order.h"

namespace coppice {

namespace {

// Each vertex queues with its cheapest candidate. Where that is refused it goes on to the next, until its
// surroundings change.
class CheapestFirst {
  public:
    CheapestFirst(EndPointCollapse& work, const Watch& watch)
        : work_(work),
          mesh_(work.mesh()),
          watch_(watch),
          heap_(mesh_.vertex_count()),
          candidates_(watched_vector<Candidate>(mesh_.vertex_count(), watch)),
          skipped_(mesh_.vertex_count()),
          around_(mesh_.vertex_count(), watch) {}

    // A collapse can make possible what was refused two rings away. So there is another round, while they
    // pay.
    void run() {
        uint64_t collapses = 0;
        do {
            work_.forget_refusals();
            queue_all();
            collapses = drain();
        } while (!work_.done() && collapses > mesh_.live_vertices() / 1000);
    }

  private:
    void queue_all() {
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            if (mesh_.is_live_vertex(v)) queue(v, work_.next_candidate(v));
        }
    }

    uint64_t drain() {
        uint64_t collapses = 0;
        for (uint64_t step = 0; !heap_.empty() && !work_.done(); ++step) {
            if (step % 512 == 0) watch_.report(work_.fraction());
            collapses += try_cheapest();
        }
        return collapses;
    }

    bool try_cheapest() {
        const uint32_t removed = heap_.top();
        const Candidate candidate = candidates_[removed];
        if (is_hub(candidate.kept) && has_become_dearer(removed, candidate)) return false;
        // What stays has at most the triangles of both.
        const bool becomes_hub =
            mesh_.valence(removed) + mesh_.valence(candidate.kept) > largest_removable_valence;
        if (becomes_hub) gather_ring(removed);
        if (work_.try_collapse(removed, candidate.kept) != Refusal::none) {
            queue(removed, work_.next_candidate(removed, candidate));
            skipped_[removed] = true;
            return false;
        }
        heap_.erase(removed);
        if (!is_hub(candidate.kept)) gather_ring(candidate.kept);
        for (const uint32_t v : ring_) {
            if (mesh_.is_live_vertex(v) && v != candidate.kept) rank_again(v, removed, candidate.kept);
        }
        if (mesh_.is_live_vertex(candidate.kept)) queue(candidate.kept, work_.next_candidate(candidate.kept));
        return true;
    }

    // After a collapse beside this vertex: only the way to the vertex that stayed has another price now.
    void rank_again(uint32_t vertex, uint32_t removed, uint32_t kept) {
        const Candidate& best = candidates_[vertex];
        if (skipped_[vertex] || !best.exists() || best.kept == kept || best.kept == removed) {
            queue(vertex, work_.next_candidate(vertex));
            return;
        }
        const std::optional<double> error = work_.cost(vertex, kept);
        if (error && Candidate{kept, *error} < best) queue(vertex, {kept, *error});
    }

    // Around a vertex with very many triangles only the changed side is ranked anew at once, the rest when
    // its turn comes.
    bool is_hub(uint32_t vertex) const { return mesh_.valence(vertex) > largest_removable_valence; }

    bool has_become_dearer(uint32_t removed, const Candidate& candidate) {
        const std::optional<double> now = work_.cost(removed, candidate.kept);
        if (now && *now <= candidate.error) return false;
        queue(removed, now ? Candidate{candidate.kept, *now} : work_.next_candidate(removed, candidate));
        skipped_[removed] = true;
        return true;
    }

    void gather_ring(uint32_t vertex) {
        around_.gather(mesh_, vertex);
        ring_ = around_.all();
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

    EndPointCollapse& work_;
    const CollapseMesh& mesh_;
    const Watch& watch_;
    IndexedHeap heap_;
    std::vector<Candidate> candidates_;  // per vertex: what it is queued with
    std::vector<bool> skipped_;          // per vertex: whether cheaper candidates were refused
    Neighbours around_;
    std::vector<uint32_t> ring_;
};

}  // namespace

void collapse_cheapest_first(EndPointCollapse& work, const Watch& watch) {
    CheapestFirst(work, watch).run();
}

}  // namespace coppice
