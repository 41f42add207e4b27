#include <algorithm>
#include <cmath>
#include <vector>

#include "core/simplify/its_faithful.h"

namespace coppice {

namespace {

// "If there exist more than ten valid pairs under this threshold, then the threshold gets halved."
constexpr size_t most_pairs = 10;

struct Pair {
    double length = 0;
    uint32_t a = 0, b = 0;  // a < b

    friend bool operator<(const Pair& p, const Pair& q) {
        if (p.length != q.length) return p.length < q.length;
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
    friend bool operator>(const Pair& p, const Pair& q) { return q < p; }
    friend bool operator==(const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }
};

// One way to collapse one of the pairs.
struct Option {
    size_t pair = 0;
    uint32_t removed = 0, kept = 0;
    double error = 0;

    friend bool operator<(const Option& x, const Option& y) {
        if (x.error != y.error) return x.error < y.error;
        return x.removed != y.removed ? x.removed < y.removed : x.kept < y.kept;
    }
};

// Counting the pairs under t needs only the eleven shortest edges, so edges wait in a heap by length. Ends
// never move: an edge keeps its length as long as it exists.
class UnderThreshold {
  public:
    UnderThreshold(EdgeCollapse& work, std::optional<double> first_threshold, const Watch& watch)
        : work_(work),
          mesh_(work.mesh()),
          watch_(watch),
          steps_(watch),
          around_(mesh_.vertex_count(), watch) {
        gather_pairs();
        threshold_ = first_threshold ? *first_threshold : mean_length() / 4;
    }

    void run() {
        uint64_t collapses = 0;
        do {
            work_.forget_refusals();
            for (const Pair& pair : refused_) push(pair);
            refused_.clear();
            collapses = drain();
        } while (!work_.done() && collapses > mesh_.live_vertices() / 1000);
    }

  private:
    uint64_t drain() {
        uint64_t collapses = 0;
        for (uint64_t step = 0; !work_.done() && take_shortest(); ++step) {
            if (step % 512 == 0) watch_.report(work_.fraction());
            collapses += collapse_one(adapt_threshold());
        }
        return collapses;
    }

    void gather_pairs() {
        heap_.reserve(3 * size_t{mesh_.live_triangles()} / 2 + mesh_.live_vertices());
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            around_.gather(mesh_, v, steps_);
            for (const uint32_t u : around_.all()) {
                if (v < u) heap_.push_back(pair(v, u));
            }
        }
        std::make_heap(heap_.begin(), heap_.end(), steps_.counting(std::greater<>()));
    }

    Pair pair(uint32_t u, uint32_t v) const {
        return {length(mesh_.position(u) - mesh_.position(v)), std::min(u, v), std::max(u, v)};
    }

    double mean_length() const {
        double sum = 0;
        watched_loop(heap_.size(), watch_, [&](size_t i) { sum += heap_[i].length; });
        return heap_.empty() || !(sum > 0) ? 1.0 : sum / static_cast<double>(heap_.size());
    }

    void push(const Pair& pair) {
        heap_.push_back(pair);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }

    bool exists(const Pair& p) {
        if (!mesh_.is_live_vertex(p.a) || !mesh_.is_live_vertex(p.b)) return false;
        const bool a_is_smaller = mesh_.valence(p.a) < mesh_.valence(p.b);
        const uint32_t from = a_is_smaller ? p.a : p.b, to = a_is_smaller ? p.b : p.a;
        for (uint32_t c = mesh_.first_corner(from); c != no_index; c = mesh_.corner_after(c)) {
            steps_.add(1);
            if (mesh_.corner_vertex(CollapseMesh::next_corner(c)) == to) return true;
            if (mesh_.corner_vertex(CollapseMesh::previous_corner(c)) == to) return true;
        }
        return false;
    }

    // One more than the threshold may leave, where there are so many. False when there is none.
    bool take_shortest() {
        shortest_.clear();
        while (shortest_.size() <= most_pairs && !heap_.empty()) {
            std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
            const Pair p = heap_.back();
            heap_.pop_back();
            const bool again = !shortest_.empty() && shortest_.back() == p;
            if (!again && exists(p)) shortest_.push_back(p);
        }
        return !shortest_.empty();
    }

    size_t count_under(double threshold) const {
        return static_cast<size_t>(std::count_if(
            shortest_.begin(), shortest_.end(), [threshold](const Pair& p) { return p.length < threshold; }));
    }

    // Doubles or halves the threshold as the paper says; returns how many of the shortest edges are valid
    // pairs.
    size_t adapt_threshold() {
        while (count_under(threshold_) == 0) threshold_ *= 2;
        while (count_under(threshold_) > most_pairs && count_under(threshold_ / 2) > 0) threshold_ /= 2;
        return std::min(count_under(threshold_), most_pairs);
    }

    bool collapse_one(size_t valid_pairs) {
        for (size_t i = valid_pairs; i < shortest_.size(); ++i) push(shortest_[i]);
        shortest_.resize(valid_pairs);
        options_.clear();
        for (size_t i = 0; i < valid_pairs; ++i) {
            add_option(i, shortest_[i].a, shortest_[i].b);
            add_option(i, shortest_[i].b, shortest_[i].a);
        }
        std::sort(options_.begin(), options_.end());
        tried_.assign(valid_pairs, 0);
        const auto collapsed = std::find_if(options_.begin(), options_.end(), [this](const Option& o) {
            ++tried_[o.pair];
            return try_collapse(o);
        });
        put_back(collapsed);
        return collapsed != options_.end();
    }

    void add_option(size_t index, uint32_t removed, uint32_t kept) {
        const std::optional<double> error = work_.cost(removed, kept);
        if (error) options_.push_back({index, removed, kept, *error});
    }

    // Pairs all of whose options were tried wait for another round; the others for the next step.
    void put_back(std::vector<Option>::const_iterator collapsed) {
        for (size_t i = 0; i < shortest_.size(); ++i) {
            if (collapsed != options_.end() && collapsed->pair == i) continue;
            const auto options =
                std::count_if(options_.begin(), options_.end(), [i](const Option& o) { return o.pair == i; });
            if (options == tried_[i]) {
                refused_.push_back(shortest_[i]);
            } else {
                push(shortest_[i]);
            }
        }
    }

    bool try_collapse(const Option& o) {
        around_.gather(mesh_, o.kept, steps_);
        before_ = around_.all();
        std::sort(before_.begin(), before_.end(), steps_.counting(std::less<>()));
        if (!work_.try_collapse(o.removed, o.kept)) return false;
        around_.gather(mesh_, o.kept, steps_);
        for (const uint32_t v : around_.all()) {
            if (!std::binary_search(before_.begin(), before_.end(), v)) push(pair(o.kept, v));
        }
        return true;
    }

    EdgeCollapse& work_;
    const CollapseMesh& mesh_;
    const Watch& watch_;
    WatchedSteps steps_;
    double threshold_ = 0;
    std::vector<Pair> heap_;      // least length on top
    std::vector<Pair> shortest_;  // ascending
    std::vector<Pair> refused_;
    std::vector<Option> options_;
    std::vector<std::ptrdiff_t> tried_;  // per pair of shortest_
    Neighbours around_;
    std::vector<uint32_t> before_;  // neighbours, sorted
};

}  // namespace

void collapse_under_threshold(EdgeCollapse& work, std::optional<double> first_threshold, const Watch& watch) {
    UnderThreshold(work, first_threshold, watch).run();
}

}  // namespace coppice
