#include "core/format/obj/object_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr uint32_t none = 0xffffffff;
constexpr size_t longest_number = 32;

void put_float(std::string& out, float value) {
    std::array<char, longest_number> text;
    const auto [end, error] = std::to_chars(text.begin(), text.end(), value == 0 ? 0.0F : value);
    out.append(text.begin(), end);
}

void put_index(std::string& out, uint64_t value) {
    std::array<char, longest_number> text;
    const auto [end, error] = std::to_chars(text.begin(), text.end(), value);
    out.append(text.begin(), end);
}

// v = 1 - t with as few digits as give t again when it is read: 0.1, where the difference of the floats is
// 0.10000002.
void put_flipped(std::string& out, float t) {
    constexpr int fewest_digits = 6, most_digits = 9;
    const double v = 1.0 - t;
    for (int digits = fewest_digits; digits <= most_digits; ++digits) {
        std::array<char, longest_number> text;
        if (std::abs(v) >= 1e6) break;
        const auto [end, error] =
            std::to_chars(text.begin(), text.end(), v, std::chars_format::fixed, digits);
        double read = 0;
        std::from_chars(text.begin(), end, read);
        if (1 - static_cast<float>(read) != t) continue;
        std::string_view shortest(text.begin(), end);
        shortest = shortest.substr(0, shortest.find_last_not_of('0') + 1);
        if (shortest.ends_with('.')) shortest.remove_suffix(1);
        out += shortest == "-0" ? "0" : shortest;
        return;
    }
    put_float(out, static_cast<float>(v));
}

template <size_t components>
std::array<float, components> value_at(const Attribute& attribute, uint32_t wedge) {
    std::array<float, components> value{};
    const size_t have = std::min<size_t>(components, attribute.components);
    std::copy_n(attribute.values.begin() + static_cast<std::ptrdiff_t>(size_t{wedge} * attribute.components),
                have, value.begin());
    return value;
}

// Which numbers the corners of one mesh get.
struct Numbering {
    std::vector<uint32_t> vertex, uv, normal;  // by wedge, from 0; none where unused or absent
};

// Numbers the different values of the wedges that triangles use in the order of their first use, and gives
// these values. Equals are found by sorting: a file could be made whose values all have one hash.
template <size_t components>
std::vector<std::array<float, components>> number_values(const Mesh& mesh, const Attribute& attribute,
                                                         std::vector<uint32_t>& numbers, const Watch& watch) {
    using Bits = std::array<uint32_t, components>;
    struct Use {
        Bits value{};
        uint32_t wedge = 0;
        uint32_t order = 0;  // of its first use
    };
    std::vector<Use> uses;
    numbers.assign(mesh.wedge_count(), none);
    watched_loop(mesh.triangles.size(), watch, [&](size_t corner) {
        const uint32_t wedge = mesh.triangles[corner];
        if (numbers[wedge] != none) return;
        numbers[wedge] = static_cast<uint32_t>(uses.size());
        auto value = value_at<components>(attribute, wedge);
        for (float& v : value) v += 0.0F;  // -0 is 0
        uses.push_back({std::bit_cast<Bits>(value), wedge, numbers[wedge]});
    });
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
        return std::tie(a.value, a.order) < std::tie(b.value, b.order);
    });
    std::vector<const Use*> first_of(uses.size());  // by order: the first use of the same value
    watched_loop(uses.size(), watch, [&](size_t i) {
        const bool is_equal = i > 0 && uses[i].value == uses[i - 1].value;
        first_of[uses[i].order] = is_equal ? first_of[uses[i - 1].order] : &uses[i];
    });
    std::vector<std::array<float, components>> values;
    std::vector<uint32_t> number(uses.size());  // by order
    watched_loop(uses.size(), watch, [&](size_t order) {
        const Use& first = *first_of[order];
        if (first.order != order) {
            number[order] = number[first.order];
            return;
        }
        number[order] = static_cast<uint32_t>(values.size());
        values.push_back(std::bit_cast<std::array<float, components>>(first.value));
    });
    for (const Use& use : uses) numbers[use.wedge] = number[use.order];
    return values;
}

// Vertices in the mesh's order, those that triangles use. A vertex whose wedges differ in colour is written
// for each.
void write_vertices(std::string& out, const Mesh& mesh, std::vector<uint32_t>& numbers, uint64_t& written) {
    const Attribute* colors = mesh.find_attribute("COLOR_0");
    std::vector<bool> used(mesh.wedge_count());
    for (const uint32_t wedge : mesh.triangles) used[wedge] = true;
    std::vector<uint32_t> order;  // wedges, by vertex
    for (uint32_t wedge = 0; wedge < mesh.wedge_count(); ++wedge) {
        if (used[wedge]) order.push_back(wedge);
    }
    const auto color_of = [&](uint32_t wedge) {
        return colors ? value_at<3>(*colors, wedge) : std::array<float, 3>{};
    };
    const auto key = [&](uint32_t wedge) { return std::pair(mesh.wedge_vertex[wedge], color_of(wedge)); };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    numbers.assign(mesh.wedge_count(), none);
    uint32_t count = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        const uint32_t wedge = order[i];
        if (i > 0 && key(order[i - 1]) == key(wedge)) {
            numbers[wedge] = numbers[order[i - 1]];
            continue;
        }
        numbers[wedge] = count++;
        const Vec3f& p = mesh.positions[mesh.wedge_vertex[wedge]];
        out += 'v';
        for (const float value : {p.x, p.y, p.z}) put_float(out += ' ', value);
        if (colors) {
            for (const float value : color_of(wedge)) put_float(out += ' ', value);
        }
        out += '\n';
    }
    written += count;
}

void write_uvs(std::string& out, const Mesh& mesh, std::vector<uint32_t>& numbers, uint64_t& written,
               const Watch& watch) {
    const Attribute* uvs = mesh.find_attribute("TEXCOORD_0");
    if (!uvs) return;
    const auto values = number_values<2>(mesh, *uvs, numbers, watch);
    for (const auto& uv : values) {
        put_float(out += "vt ", uv[0]);
        put_flipped(out += ' ', uv[1]);
        out += '\n';
    }
    written += values.size();
}

void write_normals(std::string& out, const Mesh& mesh, std::vector<uint32_t>& numbers, uint64_t& written,
                   const Watch& watch) {
    const Attribute* normals = mesh.find_attribute("NORMAL");
    if (!normals) return;
    const auto values = number_values<3>(mesh, *normals, numbers, watch);
    for (const auto& n : values) {
        out += "vn";
        for (const float value : n) put_float(out += ' ', value);
        out += '\n';
    }
    written += values.size();
}

bool slot_has(const Mesh& mesh, const MaterialSlot& slot, std::string_view attribute) {
    for (size_t i = 0; i < mesh.attributes.size(); ++i) {
        if (mesh.attributes[i].name == attribute) return slot.has(i);
    }
    return false;
}

}  // namespace

// Faces before the first usemtl have no material; after it only a name for "none" can say so.
void ObjectWriter::use_material(const MaterialSlot& slot) {
    if (material_names_.empty() || (!slot.material && !material_)) return;
    const std::string_view wanted = slot.material ? material_names_[*slot.material] : obj_default_material;
    if (wanted != material_) (out_ += "usemtl ").append(wanted) += '\n';
    material_ = wanted;
}

void ObjectWriter::write(const Mesh& mesh, std::string_view name, const Watch& watch) {
    const uint64_t first_vertex = vertices_ + 1, first_uv = uvs_ + 1, first_normal = normals_ + 1;
    (out_ += "o ").append(name) += '\n';
    Numbering numbers;
    write_vertices(out_, mesh, numbers.vertex, vertices_);
    write_uvs(out_, mesh, numbers.uv, uvs_, watch);
    write_normals(out_, mesh, numbers.normal, normals_, watch);
    std::vector<std::vector<uint32_t>> of_slot(mesh.slots.size());
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) of_slot[mesh.triangle_slot[t]].push_back(t);
    for (size_t s = 0; s < mesh.slots.size(); ++s) {
        if (of_slot[s].empty()) continue;
        const MaterialSlot& slot = mesh.slots[s];
        const std::string_view material =
            slot.material ? material_names_[*slot.material] : obj_default_material;
        if (!material_names_.empty() && material != material_) (out_ += "usemtl ").append(material) += '\n';
        material_ = material;
        const bool uvs = slot_has(mesh, slot, "TEXCOORD_0"), normals = slot_has(mesh, slot, "NORMAL");
        for (const uint32_t t : of_slot[s]) {
            out_ += 'f';
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t wedge = mesh.triangles[3 * size_t{t} + c];
                put_index(out_ += ' ', first_vertex + numbers.vertex[wedge]);
                if (uvs || normals) out_ += '/';
                if (uvs) put_index(out_, first_uv + numbers.uv[wedge]);
                if (normals) put_index(out_ += '/', first_normal + numbers.normal[wedge]);
            }
            out_ += '\n';
        }
    }
}

}  // namespace coppice
