#include "core/format/obj/write_obj.h"

#include <fmt/core.h>

#include <string>
#include <utility>

#include "core/format/iobj/directive.h"
#include "core/format/obj/companions.h"
#include "core/format/obj/losses.h"
#include "core/format/obj/names.h"
#include "core/format/obj/object_writer.h"
#include "core/scene/instance.h"

namespace coppice {

namespace {

std::string instance_name(const Scene& scene, const Instance& instance) {
    const Node& node = scene.nodes[instance.node];
    const std::string& name = node.name.empty() ? scene.meshes[instance.mesh].name : node.name;
    return node.batch.size() > 1 ? fmt::format("{}-{}", name, instance.in_batch) : name;
}

std::string header(const ObjCompanions& companions) {
    std::string text;
    for (const std::string& library : companions.libraries) text += "mtllib " + library + "\n";
    return text;
}

ObjFiles with_companions(const Scene& scene, ObjCompanions companions, NamedFile asset) {
    ObjFiles out;
    out.files.push_back(std::move(asset));
    for (NamedFile& file : companions.files) out.files.push_back(std::move(file));
    out.warnings = obj_losses(scene);
    for (Warning& warning : companions.warnings) out.warnings.push_back(std::move(warning));
    out.mesh_bytes.resize(scene.meshes.size());
    return out;
}

}  // namespace

ObjFiles write_obj(const Scene& scene, const WriteOptions& options, const Watch& watch) {
    ObjCompanions companions = obj_companions(scene, options.base_name);
    std::string text = "# OBJ by coppice\n" + header(companions);
    const std::vector<Instance> placed = instances(scene);
    std::vector<std::string> names;
    for (const Instance& instance : placed) names.push_back(instance_name(scene, instance));
    names = unique_line_names(names, "object");

    ObjectWriter writer(text, companions.material_names);
    std::vector<uint64_t> mesh_bytes(scene.meshes.size());
    for (size_t i = 0; i < placed.size(); ++i) {
        watch.report(static_cast<double>(i) / static_cast<double>(placed.size()));
        const size_t before = text.size();
        const Mesh& mesh = scene.meshes[placed[i].mesh];
        if (placed[i].world == Transform{}) {
            writer.write(mesh, names[i], watch);
        } else {
            Mesh baked = mesh;
            transform_mesh(placed[i].world, baked);
            writer.write(baked, names[i], watch);
        }
        mesh_bytes[placed[i].mesh] += text.size() - before;
    }
    ObjFiles out =
        with_companions(scene, std::move(companions), {options.base_name + ".obj", to_bytes(text)});
    out.mesh_bytes = std::move(mesh_bytes);
    return out;
}

ObjFiles write_iobj(const Scene& scene, const WriteOptions& options, const Watch& watch) {
    ObjCompanions companions = obj_companions(scene, options.base_name);
    std::string text = "#@iobj 1.0\n" + header(companions);
    std::vector<std::string> names;
    for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
    names = unique_line_names(names, "object");
    std::vector<std::vector<InstanceDirective>> of_mesh(scene.meshes.size());
    size_t flat = 0;
    for (const Instance& instance : instances(scene)) {
        if (determinant(instance.world) == 0) {
            ++flat;
            continue;
        }
        const std::string name = line_name(instance_name(scene, instance), names[instance.mesh]);
        of_mesh[instance.mesh].push_back({names[instance.mesh], name, instance.world});
    }

    ObjectWriter writer(text, companions.material_names);
    std::vector<uint64_t> mesh_bytes(scene.meshes.size());
    size_t unplaced = 0;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        watch.report(static_cast<double>(i) / static_cast<double>(scene.meshes.size()));
        if (of_mesh[i].empty()) {  // without a directive it would stand once
            ++unplaced;
            continue;
        }
        const size_t before = text.size();
        writer.write(scene.meshes[i], names[i], watch);
        mesh_bytes[i] = text.size() - before;
        const InstanceDirective& first = of_mesh[i].front();
        if (of_mesh[i].size() == 1 && first.name == names[i] && first.placement == Transform{}) continue;
        for (const InstanceDirective& instance : of_mesh[i])
            text += print_instance_directive(instance) + "\n";
    }
    ObjFiles out =
        with_companions(scene, std::move(companions), {options.base_name + ".iobj", to_bytes(text)});
    out.mesh_bytes = std::move(mesh_bytes);
    if (unplaced > 0) {
        out.warnings.push_back(
            {"format.lost", fmt::format("{} meshes that stand nowhere were left out", unplaced), {}});
    }
    if (flat > 0) {
        out.warnings.push_back(
            {"format.lost", fmt::format("{} instances of scale 0 were left out", flat), {}});
    }
    return out;
}

}  // namespace coppice
