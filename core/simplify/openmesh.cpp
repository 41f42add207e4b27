#include "core/simplify/openmesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <array>
#include <cassert>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/base/watched_sort.h"
#include "core/simplify/edge_collapse.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
    FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};
using PlainMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// Brings our rules into OpenMesh. Vertices have the same indices in its mesh and in ours.
class HalfEdgeMesh : public PlainMesh {
  public:
    HalfEdgeMesh(EdgeCollapse& work, const Watch& watch) : work_(work), steps_(watch) {}

    // In place of the mesh's own, which OpenMesh's decimater asks when it ranks a half-edge and again before
    // it collapses that: by then the rules may see something new beyond the vertices that it ranks anew.
    bool is_collapse_ok(OpenMesh::HalfedgeHandle edge) {
        steps_.add(steps_of_a_look);
        return PlainMesh::is_collapse_ok(edge) &&
               work_.may_collapse(index(from_vertex_handle(edge)), index(to_vertex_handle(edge)));
    }
    // In place of the mesh's own: OpenMesh asks for the corners of all triangles in one go before it begins.
    const Point& point(OpenMesh::VertexHandle v) {
        steps_.add(1);
        return PlainMesh::point(v);
    }
    // The collapse that OpenMesh does now, in our mesh.
    void follow(OpenMesh::VertexHandle removed, OpenMesh::VertexHandle kept) {
        [[maybe_unused]] const bool done = work_.try_collapse(index(removed), index(kept)).has_value();
        assert(done);
    }

  private:
    static constexpr size_t steps_of_a_look = 16;
    static uint32_t index(OpenMesh::VertexHandle v) { return static_cast<uint32_t>(v.idx()); }

    EdgeCollapse& work_;
    WatchedSteps steps_;
};

using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

// Brings OpenMesh's collapses into our mesh.
class FollowModule final : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
  public:
    using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
    using Self = FollowModule;
    using Handle = OpenMesh::Decimater::ModHandleT<FollowModule>;
    using Mesh = HalfEdgeMesh;  // of OpenMesh's decimater, which asks for these names

    explicit FollowModule(HalfEdgeMesh& mesh) : Base(mesh, true) {}

    const std::string& name() const override {
        static const std::string name = "Coppice";
        return name;
    }
    // Right before OpenMesh collapses.
    void preprocess_collapse(const CollapseInfo& info) override { mesh().follow(info.v0, info.v1); }
};

// Stops OpenMesh; its steps are collapses.
class Observer final : public OpenMesh::Decimater::Observer {
  public:
    Observer(const EdgeCollapse& work, const Watch& watch)
        : OpenMesh::Decimater::Observer(1), work_(work), watch_(watch) {}

    void notify(size_t step) override {
        if (step % 16 == 0) watch_.check();
        if (step % 512 == 0) watch_.report(work_.fraction());
    }
    bool abort() const override { return work_.done(); }

  private:
    const EdgeCollapse& work_;
    const Watch& watch_;
};

// The triangles that a half-edge mesh can hold. Vertices of the others must stay; their flag is set.
class Conversion {
  public:
    Conversion(const CollapseMesh& mesh, const Watch& watch)
        : mesh_(mesh), watch_(watch), locked_(mesh.vertex_count()) {
        gather_half_edges();
    }

    void build(HalfEdgeMesh& out) {
        reserve(out);
        watched_loop(mesh_.vertex_count(), watch_, [&](size_t v) {
            const Vec3d p = mesh_.position(static_cast<uint32_t>(v));
            out.add_vertex({p.x, p.y, p.z});
        });
        WatchedSteps steps(watch_);
        for_each_triangle(mesh_, watch_, [&](uint32_t, const std::array<uint32_t, 3>& v) {
            steps.add(steps_of_a_triangle);
            const auto handle = [&](uint32_t k) { return out.vertex_handle(v[k]); };
            const bool held = is_alone(v[0], v[1]) && is_alone(v[1], v[2]) && is_alone(v[2], v[0]) &&
                              out.add_face(handle(0), handle(1), handle(2)).is_valid();
            if (held) return;
            for (const uint32_t vertex : v) locked_[vertex] = true;
        });
        watched_loop(mesh_.vertex_count(), watch_, [&](size_t v) {
            out.status(out.vertex_handle(static_cast<uint32_t>(v))).set_locked(locked_[v]);
        });
    }

  private:
    static constexpr size_t steps_of_a_triangle = 16;  // six searches among all half-edges

    void gather_half_edges() {
        half_edges_.reserve(3 * size_t{mesh_.live_triangles()});
        for_each_triangle(mesh_, watch_, [this](uint32_t, const std::array<uint32_t, 3>& v) {
            for (uint32_t k = 0; k < 3; ++k) half_edges_.push_back(key(v[k], v[(k + 1) % 3]));
        });
        watched_sort(half_edges_.begin(), half_edges_.end(), watch_, std::less<>());
    }

    // Or its arrays double as they grow. Edges by Euler's formula; handles or many pieces may make it more.
    void reserve(HalfEdgeMesh& out) const {
        const size_t vertices = mesh_.vertex_count(), triangles = mesh_.live_triangles();
        out.reserve(vertices, vertices + triangles, triangles);
    }
    static uint64_t key(uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; }

    // One triangle runs along it this way, one at most the other way.
    bool is_alone(uint32_t from, uint32_t to) const { return uses(from, to) == 1 && uses(to, from) <= 1; }
    std::ptrdiff_t uses(uint32_t from, uint32_t to) const {
        const auto [first, last] = std::equal_range(half_edges_.begin(), half_edges_.end(), key(from, to));
        return last - first;
    }

    const CollapseMesh& mesh_;
    const Watch& watch_;
    std::vector<bool> locked_;
    std::vector<uint64_t> half_edges_;  // sorted
};

// Runs OpenMesh on what the mesh is now.
void decimate(EdgeCollapse& work, const Watch& watch) {
    HalfEdgeMesh mesh(work, watch);
    Conversion(work.mesh(), watch).build(mesh);
    Decimater decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadric;
    FollowModule::Handle follow;
    decimater.add(quadric);
    decimater.add(follow);
    decimater.module(quadric).unset_max_err();
    Observer observer(work, watch);
    decimater.set_observer(&observer);
    watch.check();
    decimater.initialize();
    watch.check();
    decimater.decimate_to_faces(0, 0);
}

// Faces that it cannot hold are expected here, and are no news for anybody's terminal.
void silence_openmesh() {
    static std::once_flag once;
    std::call_once(once, [] { omerr().disable(); });
}

Simplified simplify(const Mesh& source, std::span<const Transform> /*instances*/, const Target& target,
                    const ParameterValues& /*values*/, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    silence_openmesh();
    EdgeCollapse work(
        source, target, {.freedom = Freedom::end_point},
        [](const CollapseParts& parts) { return std::make_unique<NoError>(parts.mesh); }, watch);
    // What it passed over may be allowed after what came later.
    for (uint32_t before = 0; !work.done() && before != work.mesh().live_triangles();) {
        before = work.mesh().live_triangles();
        work.forget_refusals();
        decimate(work, watch);
    }
    watch.report(1.0);
    return work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
}

}  // namespace

Algorithm openmesh() {
    return {.id = "openmesh",
            .title = "OpenMesh's quadric decimater, as a baseline",
            .citation =
                "M. Botsch, S. Steinberg, S. Bischoff, L. Kobbelt: OpenMesh: a generic and efficient "
                "polygon mesh data structure. OpenSG Symposium 2002",
            .parameters = {},
            .keeps_values = true,
            .bytes_per_triangle = 380,
            .simplify = simplify};
}

}  // namespace coppice
