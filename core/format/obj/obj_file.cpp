#include "core/format/obj/obj_file.h"

#include <cmath>
#include <map>

#include "core/format/warning_tally.h"

namespace coppice {

namespace {

constexpr uint64_t lines_between_checks = 4096;

// The largest index that faces use of something, which may stand after them.
struct Furthest {
    uint32_t index = 0;
    std::string where;

    void reach(uint32_t used, const Line& line) {
        if (!where.empty() && used <= index) return;
        index = used;
        where = line.where();
    }
};

class ObjParser {
  public:
    ObjParser(std::string_view text, const ReadLimits& limits, const Watch& watch)
        : text_(text), limits_(limits), watch_(watch) {
        file_.instanced = is_iobj(text);
    }

    ObjFile parse() {
        LineReader reader(text_, true);
        Line line;
        while (reader.next(line)) {
            statement(line);
            if (line.number() % lines_between_checks == 0) {
                watch_.report(static_cast<double>(reader.offset()) / static_cast<double>(text_.size()));
            }
        }
        require_reached(furthest_position_, file_.positions.size(), "vertex", "v");
        if (file_.uvs.empty()) forget_indices(furthest_uv_, &ObjCorner::uv, "texture coordinates (vt)");
        if (file_.normals.empty()) forget_indices(furthest_normal_, &ObjCorner::normal, "normals (vn)");
        require_reached(furthest_uv_, file_.uvs.size(), "texture coordinate", "vt");
        require_reached(furthest_normal_, file_.normals.size(), "normal", "vn");
        tally_.move_to(file_.warnings);
        return std::move(file_);
    }

  private:
    void statement(Line& line) {
        line.skip_blanks();
        if (line.peek() == '#') return comment(line);
        const std::string_view word = line.word();
        if (word == "v") return vertex(line);
        if (word == "f" || word == "fo") return face(line);
        if (word == "vt") return uv(line);
        if (word == "vn") return normal(line);
        if (word.empty() || word == "g" || word == "s")
            return;  // groups and smoothing do not change the geometry
        if (word == "o") return object(line);
        if (word == "usemtl") return use_material(line);
        if (word == "mtllib") {
            file_.libraries.emplace_back(line.rest());
            return;
        }
        ignored(word, line);
    }

    void comment(const Line& line) {
        if (!file_.instanced || !line.text().starts_with("#@")) return;
        if (line.number() == 1) return parse_version_directive(Line(line.text(), line.number()));
        require(file_.instances.size() < limits_.nodes, ErrorCode::asset_too_large, line.where(),
                "more instances than the limit nodes of {}", limits_.nodes);
        file_.instances.push_back(parse_instance_directive(Line(line.text(), line.number())));
    }

    // A check of a limit that costs nothing while it holds.
    static void require_limit(bool holds, const Line& line, std::string_view what, std::string_view limit,
                              uint64_t value) {
        if (!holds) {
            fail(ErrorCode::asset_too_large, line.where(),
                 fmt::format("{} the limit {} of {}", what, limit, value));
        }
    }

    static float finite(Line& line, std::string_view what) {
        const auto value = static_cast<float>(line.number(what));
        if (!std::isfinite(value)) line.fail("{} is not a finite 32-bit number", what);
        return value;
    }

    // v x y z [w] or v x y z r g b [a]
    void vertex(Line& line) {
        Vec3f position;
        position.x = finite(line, "the x of a vertex");
        position.y = finite(line, "the y of a vertex");
        position.z = finite(line, "the z of a vertex");
        file_.positions.push_back(position);
        if (!file_.colors.empty()) file_.colors.push_back({1, 1, 1});
        if (!line.ended()) vertex_color(line);
        require_limit(file_.positions.size() <= limits_.vertices, line, "more vertices than", "vertices",
                      limits_.vertices);
    }

    void vertex_color(Line& line) {
        const auto red = static_cast<float>(line.number("the fourth number of a vertex"));
        if (line.ended()) return;  // that was w, the weight of a curve's control point
        Vec3f color = {red, 0, 0};
        color.y = static_cast<float>(line.number("the green of a vertex"));
        color.z = static_cast<float>(line.number("the blue of a vertex"));
        if (!line.ended()) {
            line.number("the alpha of a vertex");
            tally_.note("obj.alpha_lost", "the alpha of vertex colours is not kept", line.where());
        }
        if (!line.ended())
            line.fail("a vertex takes x y z, then w, or r g b and alpha: this has more numbers");
        if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z)) {
            tally_.note("repair.non_finite", "a vertex colour is not finite; it was made white",
                        line.where());
            color = {1, 1, 1};
        }
        file_.colors.resize(file_.positions.size(), {1, 1, 1});
        file_.colors.back() = color;
    }

    void uv(Line& line) {
        std::array<float, 2> uv = {static_cast<float>(line.number("the u of a texture coordinate")), 0};
        if (!line.ended()) uv[1] = static_cast<float>(line.number("the v of a texture coordinate"));
        for (float& value : uv) {
            if (std::isfinite(value)) continue;
            tally_.note("repair.non_finite", "a texture coordinate is not finite; it was made 0",
                        line.where());
            value = 0;
        }
        file_.uvs.push_back(uv);
        require_limit(file_.uvs.size() <= 3 * limits_.vertices, line,
                      "more texture coordinates than three times", "vertices", limits_.vertices);
    }

    // Kept as it is: what has no direction is repaired once its triangles are known.
    void normal(Line& line) {
        Vec3f n;
        n.x = static_cast<float>(line.number("the x of a normal"));
        n.y = static_cast<float>(line.number("the y of a normal"));
        n.z = static_cast<float>(line.number("the z of a normal"));
        file_.normals.push_back(n);
        require_limit(file_.normals.size() <= 3 * limits_.vertices, line, "more normals than three times",
                      "vertices", limits_.vertices);
    }

    void face(Line& line) {
        const size_t first = file_.corners.size();
        while (!line.ended()) file_.corners.push_back(corner(line));
        const size_t count = file_.corners.size() - first;
        if (count < 3) line.fail("a face needs at least 3 corners, this has {}", count);
        triangles_ += count - 2;
        require_limit(triangles_ <= limits_.triangles && file_.corners.size() < obj_none, line,
                      "more triangles than", "triangles", limits_.triangles);
        if (run_ended_) begin_run();
        file_.face_ends.push_back(static_cast<uint32_t>(file_.corners.size()));
    }

    // v, v/vt, v//vn or v/vt/vn
    ObjCorner corner(Line& line) {
        ObjCorner c;
        c.position = index(line, file_.positions.size(), "vertex", furthest_position_);
        if (line.accept('/')) {
            if (line.peek() != '/' && !line.at_blank()) {
                c.uv = index(line, file_.uvs.size(), "texture coordinate", furthest_uv_);
            }
            if (line.accept('/') && !line.at_blank()) {
                c.normal = index(line, file_.normals.size(), "normal", furthest_normal_);
            }
        }
        if (!line.at_blank()) line.fail("a corner is v, v/vt, v//vn or v/vt/vn");
        return c;
    }

    // From 1, or from -1 backwards, to from 0.
    static uint32_t index(Line& line, size_t count, std::string_view what, Furthest& furthest) {
        const int64_t given = line.integer(what);
        if (given < 0) {
            if (static_cast<uint64_t>(-(given + 1)) >= count) {
                line.fail("{} {} is out of range: {} stand before it", what, given, count);
            }
            return static_cast<uint32_t>(static_cast<int64_t>(count) + given);
        }
        if (given == 0 || given >= obj_none) line.fail("{} {} is out of range: the first is 1", what, given);
        const auto from_zero = static_cast<uint32_t>(given - 1);
        if (from_zero >= count) furthest.reach(from_zero, line);
        return from_zero;
    }

    static void require_reached(const Furthest& furthest, size_t count, std::string_view what,
                                std::string_view statement) {
        require(furthest.where.empty() || furthest.index < count, ErrorCode::asset_malformed, furthest.where,
                "{} {} is out of range: the file has {} ({})", what, uint64_t{furthest.index} + 1, count,
                statement);
    }

    // Some exporters number what they then do not write.
    void forget_indices(Furthest& furthest, uint32_t ObjCorner::*index, std::string_view what) {
        if (furthest.where.empty()) return;
        tally_.note("obj.indices_ignored", fmt::format("faces name {}, of which the file has none", what),
                    furthest.where);
        for (ObjCorner& c : file_.corners) c.*index = obj_none;
        furthest = {};
    }

    void begin_run() {
        if (file_.objects.empty()) {
            file_.objects.emplace_back("default");
            object_names_.emplace("default", 0);
        }
        const auto object = static_cast<uint32_t>(file_.objects.size() - 1);
        file_.runs.push_back({object, material_, file_.face_ends.size()});
        run_ended_ = false;
    }

    void object(Line& line) {
        const std::string name(line.rest());
        if (file_.instanced && !object_names_.emplace(name, 0).second) {
            line.fail("object \"{}\" is there already; names are unique in an instanced OBJ", name);
        }
        require(file_.objects.size() < limits_.meshes_and_primitives, ErrorCode::asset_too_large,
                line.where(), "more objects than the limit meshes_and_primitives of {}",
                limits_.meshes_and_primitives);
        file_.objects.push_back(name);
        run_ended_ = true;
    }

    void use_material(Line& line) {
        const std::string name(line.rest());
        const auto [at, is_new] =
            material_numbers_.emplace(name, static_cast<uint32_t>(file_.materials.size()));
        if (is_new) file_.materials.push_back(name);
        require(file_.materials.size() <= limits_.meshes_and_primitives, ErrorCode::asset_too_large,
                line.where(), "more materials than the limit meshes_and_primitives of {}",
                limits_.meshes_and_primitives);
        material_ = at->second;
        run_ended_ = true;
    }

    void ignored(std::string_view word, const Line& line) {
        if (word == "l") return tally_.note("obj.lines_lost", "line elements are not kept", line.where());
        if (word == "p") return tally_.note("obj.points_lost", "point elements are not kept", line.where());
        tally_.note("obj.statement_ignored",
                    "statements other than v, vt, vn, f, o, g, s, usemtl, mtllib are skipped",
                    fmt::format("{} (\"{}\")", line.where(), word.substr(0, 40)));
    }

    std::string_view text_;
    const ReadLimits& limits_;
    const Watch& watch_;
    ObjFile file_;
    WarningTally tally_;
    // Not hashed: a file could be made whose names all have one hash.
    std::map<std::string, uint32_t> object_names_, material_numbers_;
    uint32_t material_ = obj_none;
    bool run_ended_ = true;
    uint64_t triangles_ = 0;
    Furthest furthest_position_, furthest_uv_, furthest_normal_;
};

}  // namespace

ObjFile parse_obj(std::string_view text, const ReadLimits& limits, const Watch& watch) {
    return ObjParser(text, limits, watch).parse();
}

}  // namespace coppice
