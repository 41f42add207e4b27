#include "core/simplify/openmesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

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
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

// A collapse that was ranked is not allowed any more, since something changed beyond OpenMesh's sight.
struct OutOfDate {};

// Brings our rules into OpenMesh, and its collapses into our mesh. Vertices have the same indices in both.
class RulesModule final : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
  public:
    using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
    using Self = RulesModule;
    using Handle = OpenMesh::Decimater::ModHandleT<RulesModule>;
    using Mesh = HalfEdgeMesh;  // of OpenMesh's decimater, which asks for these names

    explicit RulesModule(HalfEdgeMesh& mesh) : Base(mesh, true) {}

    const std::string& name() const override {
        static const std::string name = "Coppice";
        return name;
    }
    void use(EdgeCollapse& work) { work_ = &work; }

    float collapse_priority(const CollapseInfo& info) override {
        return work_->may_collapse(index(info.v0), index(info.v1)) ? Base::LEGAL_COLLAPSE
                                                                   : Base::ILLEGAL_COLLAPSE;
    }
    // Called right before OpenMesh collapses, which leaves its mesh as it is when this throws.
    void preprocess_collapse(const CollapseInfo& info) override {
        if (!work_->try_collapse(index(info.v0), index(info.v1))) throw OutOfDate();
    }

  private:
    static uint32_t index(OpenMesh::VertexHandle v) { return static_cast<uint32_t>(v.idx()); }

    EdgeCollapse* work_ = nullptr;
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
    explicit Conversion(const CollapseMesh& mesh) : mesh_(mesh), locked_(mesh.vertex_count()) {
        gather_half_edges();
    }

    void build(HalfEdgeMesh& out) {
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            const Vec3d p = mesh_.position(v);
            out.add_vertex({p.x, p.y, p.z});
        }
        for (uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
            if (!mesh_.is_live_triangle(t)) continue;
            const uint32_t v[] = {mesh_.corner_vertex(3 * t), mesh_.corner_vertex(3 * t + 1),
                                  mesh_.corner_vertex(3 * t + 2)};
            const auto handle = [&](uint32_t k) { return out.vertex_handle(v[k]); };
            const bool held = is_alone(v[0], v[1]) && is_alone(v[1], v[2]) && is_alone(v[2], v[0]) &&
                              out.add_face(handle(0), handle(1), handle(2)).is_valid();
            if (held) continue;
            for (const uint32_t vertex : v) locked_[vertex] = true;
        }
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v)
            out.status(out.vertex_handle(v)).set_locked(locked_[v]);
    }

  private:
    void gather_half_edges() {
        for (uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
            if (!mesh_.is_live_triangle(t)) continue;
            for (uint32_t k = 0; k < 3; ++k) {
                half_edges_.push_back(
                    key(mesh_.corner_vertex(3 * t + k), mesh_.corner_vertex(3 * t + (k + 1) % 3)));
            }
        }
        std::sort(half_edges_.begin(), half_edges_.end());
    }
    static uint64_t key(uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; }

    // One triangle runs along it this way, one at most the other way.
    bool is_alone(uint32_t from, uint32_t to) const { return uses(from, to) == 1 && uses(to, from) <= 1; }
    std::ptrdiff_t uses(uint32_t from, uint32_t to) const {
        const auto [first, last] = std::equal_range(half_edges_.begin(), half_edges_.end(), key(from, to));
        return last - first;
    }

    const CollapseMesh& mesh_;
    std::vector<bool> locked_;
    std::vector<uint64_t> half_edges_;  // sorted
};

// Runs OpenMesh on what the mesh is now. True when it had to stop for a collapse that was out of date.
bool decimate(EdgeCollapse& work, const Watch& watch) {
    HalfEdgeMesh mesh;
    Conversion(work.mesh()).build(mesh);
    watch.check();
    Decimater decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadric;
    RulesModule::Handle rules;
    decimater.add(quadric);
    decimater.add(rules);
    decimater.module(quadric).unset_max_err();
    decimater.module(rules).use(work);
    Observer observer(work, watch);
    decimater.set_observer(&observer);
    decimater.initialize();
    try {
        decimater.decimate_to_faces(0, 0);
    } catch (const OutOfDate&) {
        return true;
    }
    return false;
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
    for (uint32_t before = 0; !work.done() && before != work.mesh().live_triangles();) {
        before = work.mesh().live_triangles();
        work.forget_refusals();
        if (!decimate(work, watch)) break;
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
            .simplify = simplify};
}

}  // namespace coppice
