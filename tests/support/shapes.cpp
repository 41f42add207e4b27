#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/mesh/weld.h"

namespace coppice::shapes {

namespace {

constexpr double pi = std::numbers::pi;

struct Point {
    Vec3d position = {};
    Vec3d normal = {};
    double u = 0, v = 0;
    Vec3d color = {};
};

// Collects triangles corner by corner; finish() welds.
class Builder {
  public:
    bool normals = false, uvs = false, colors = false;

    void triangle(const Point& a, const Point& b, const Point& c, uint32_t slot = 0) {
        for (const Point* p : {&a, &b, &c}) {
            mesh_.triangles.push_back(static_cast<uint32_t>(mesh_.wedge_vertex.size()));
            mesh_.wedge_vertex.push_back(static_cast<uint32_t>(mesh_.positions.size()));
            mesh_.positions.push_back(to_float(p->position));
            points_.push_back(*p);
        }
        mesh_.triangle_slot.push_back(slot);
        while (mesh_.slots.size() <= slot) mesh_.slots.push_back({});
    }

    // The quad a b c d, counter-clockwise.
    void quad(const Point& a, const Point& b, const Point& c, const Point& d, uint32_t slot = 0) {
        triangle(a, b, c, slot);
        triangle(a, c, d, slot);
    }

    Mesh finish() {
        if (normals) stream("NORMAL", 3, [](const Point& p) { return p.normal; });
        if (uvs) stream("TEXCOORD_0", 2, [](const Point& p) { return Vec3d{p.u, p.v, 0}; });
        if (colors) stream("COLOR_0", 3, [](const Point& p) { return p.color; });
        if (mesh_.slots.empty()) mesh_.slots.push_back({});
        for (uint32_t i = 0; i < mesh_.slots.size(); ++i) mesh_.slots[i].material = i;
        weld(mesh_);
        return std::move(mesh_);
    }

  private:
    void stream(const char* name, uint32_t components, const std::function<Vec3d(const Point&)>& value) {
        Attribute a = {.name = name, .components = components};
        for (const Point& p : points_) {
            const Vec3f v = to_float(value(p));
            const float numbers[] = {v.x, v.y, v.z};
            a.values.insert(a.values.end(), numbers, numbers + components);
        }
        mesh_.attributes.push_back(std::move(a));
    }

    Mesh mesh_;
    std::vector<Point> points_;
};

// Exact at whole turns, so that the first and the last column weld.
Vec3d direction(uint32_t i, uint32_t segments) {
    const double angle = 2 * pi * (i % segments) / segments;
    return {std::cos(angle), 0, -std::sin(angle)};
}

Point on_sphere(uint32_t i, uint32_t j, uint32_t segments, uint32_t rings, double radius) {
    const double down = pi * j / rings;
    const bool pole = j == 0 || j == rings;
    const Vec3d around = pole ? Vec3d{} : direction(i, segments) * std::sin(down);
    Point p;
    p.normal = normalized(around + Vec3d{0, j == 0 ? 1 : j == rings ? -1 : std::cos(down), 0});
    p.position = p.normal * radius;
    p.u = static_cast<double>(i) / segments;
    p.v = static_cast<double>(j) / rings;
    return p;
}

using SpherePoint = std::function<Point(uint32_t, uint32_t)>;

// Calls triangle(a, b, c, column) for every triangle between points (i, j), j = 0 and j = rings being poles.
void tile_sphere(uint32_t segments, uint32_t rings, const SpherePoint& at,
                 const std::function<void(const Point&, const Point&, const Point&, uint32_t)>& triangle) {
    for (uint32_t j = 0; j < rings; ++j) {
        for (uint32_t i = 0; i < segments; ++i) {
            const Point a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
            if (j + 1 < rings) triangle(a, b, c, i);
            if (j > 0) triangle(a, c, d, i);
        }
    }
}

void tile_grid(Builder& builder, uint32_t columns, uint32_t rows,
               const std::function<Point(uint32_t, uint32_t)>& at) {
    for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            builder.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
    }
}

}  // namespace

Mesh sphere(Sphere shape) {
    Builder builder;
    builder.normals = shape.normals;
    tile_sphere(
        shape.segments, shape.rings,
        [&](uint32_t i, uint32_t j) { return on_sphere(i, j, shape.segments, shape.rings, shape.radius); },
        [&](const Point& a, const Point& b, const Point& c, uint32_t column) {
            builder.triangle(a, b, c, column * shape.materials / shape.segments);
        });
    return builder.finish();
}

Mesh cylinder(Cylinder shape) {
    Builder builder;
    builder.normals = shape.normals;
    builder.uvs = shape.seam;
    tile_grid(builder, shape.segments, shape.rows, [&](uint32_t i, uint32_t j) {
        Point p;
        p.normal = direction(i, shape.segments);
        p.position = p.normal + Vec3d{0, 2.0 - 4.0 * j / shape.rows, 0};
        p.u = static_cast<double>(i) / shape.segments;
        p.v = static_cast<double>(j) / shape.rows;
        return p;
    });
    return builder.finish();
}

Mesh grid(Grid shape) {
    Builder builder;
    builder.normals = shape.normals;
    builder.uvs = shape.uvs;
    builder.colors = shape.colors;
    tile_grid(builder, shape.columns, shape.rows, [&](uint32_t i, uint32_t j) {
        const double x = static_cast<double>(i) / shape.columns, z = static_cast<double>(j) / shape.rows;
        const double w = 2 * pi;
        Point p;
        p.position = {x, shape.height * std::sin(w * x) * std::cos(w * z), z};
        p.normal = normalized(Vec3d{-shape.height * w * std::cos(w * x) * std::cos(w * z), 1,
                                    shape.height * w * std::sin(w * x) * std::sin(w * z)});
        p.u = x;
        p.v = z;
        p.color = {x, 0.5, 0.25};
        return p;
    });
    return builder.finish();
}

Mesh tiles(Tiles shape) {
    Builder builder;
    builder.uvs = shape.uvs;
    for (uint32_t tile = 0; tile < shape.columns * shape.rows; ++tile) {
        const uint32_t column = tile % shape.columns, row = tile / shape.columns;
        tile_grid(builder, shape.cells, shape.cells, [&](uint32_t i, uint32_t j) {
            Point p;
            p.u = static_cast<double>(i) / shape.cells;
            p.v = static_cast<double>(j) / shape.cells;
            p.position = {column + p.u * (1 - shape.gap), 0, row + p.v * (1 - shape.gap)};
            return p;
        });
    }
    return builder.finish();
}

Mesh torus(Torus shape) {
    Builder builder;
    builder.normals = true;
    tile_grid(builder, shape.segments, shape.sides, [&](uint32_t i, uint32_t j) {
        const Vec3d out = direction(i, shape.segments);
        const double angle = -2 * pi * (j % shape.sides) / shape.sides;
        Point p;
        p.normal = out * std::cos(angle) + Vec3d{0, std::sin(angle), 0};
        p.position = out * shape.radius + p.normal * shape.thickness;
        return p;
    });
    return builder.finish();
}

Mesh box(Box shape) {
    Builder builder;
    builder.normals = shape.faceted;
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const Vec3d n = axes[axis] * side, s = axes[(axis + 1) % 3] * side, t = axes[(axis + 2) % 3];
            tile_grid(builder, shape.cells, shape.cells, [&](uint32_t i, uint32_t j) {
                const double x = static_cast<double>(i) / shape.cells - 0.5;
                const double y = 0.5 - static_cast<double>(j) / shape.cells;
                return Point{.position = n * 0.5 + s * x + t * y, .normal = n};
            });
        }
    }
    return builder.finish();
}

Mesh faceted_sphere(uint32_t segments, uint32_t rings) {
    Builder builder;
    builder.normals = true;
    builder.colors = true;
    tile_sphere(
        segments, rings, [&](uint32_t i, uint32_t j) { return on_sphere(i, j, segments, rings, 1); },
        [&](Point a, Point b, Point c, uint32_t column) {
            const Vec3d n = normalized(cross(b.position - a.position, c.position - a.position));
            for (Point* p : {&a, &b, &c}) {
                p->normal = n;
                p->color = {static_cast<double>(column % 7) / 7, 0.5, 0.5};
            }
            builder.triangle(a, b, c);
        });
    return builder.finish();
}

Mesh tetrahedron() {
    Builder builder;
    const Point p[] = {
        {.position = {0, 0, 0}}, {.position = {1, 0, 0}}, {.position = {0, 1, 0}}, {.position = {0, 0, 1}}};
    builder.triangle(p[0], p[2], p[1]);
    builder.triangle(p[0], p[1], p[3]);
    builder.triangle(p[1], p[2], p[3]);
    builder.triangle(p[2], p[0], p[3]);
    return builder.finish();
}

Mesh soup(uint32_t triangles, uint32_t seed) {
    std::mt19937 random(seed);  // its numbers are the same everywhere; distributions' are not
    const auto point = [&random] {
        const auto digit = [&random] { return static_cast<double>(random() % 6) / 5; };
        const double x = digit(), y = digit(), z = digit();
        return Point{.position = {x, y, z}};
    };
    Builder builder;
    for (uint32_t i = 0; i < triangles; ++i) {
        const Point a = point(), b = point(), c = point();
        builder.triangle(a, b, c);
    }
    Mesh mesh = builder.finish();
    drop_degenerate_and_duplicate(mesh);
    drop_unused(mesh);
    return mesh;
}

Mesh fin(uint32_t cells) {
    Builder builder;
    const auto at = [cells](uint32_t i) { return static_cast<double>(i) / cells; };
    tile_grid(builder, cells, cells, [&](uint32_t i, uint32_t j) {
        return Point{.position = {at(i), 0, at(j)}};
    });
    tile_grid(builder, cells, cells / 2, [&](uint32_t i, uint32_t j) {
        return Point{.position = {at(i), at(cells / 2 - j), at(cells / 2)}};
    });
    return builder.finish();
}

Mesh skinned_strip(uint32_t cells) {
    Builder builder;
    builder.uvs = true;
    tile_grid(builder, cells, 2, [&](uint32_t i, uint32_t j) {
        const double x = static_cast<double>(i) / cells;
        return Point{.position = {4 * x, 0, 0.2 * j}, .u = x, .v = 0.5 * j};
    });
    Mesh mesh = builder.finish();
    Attribute joints = {.name = "JOINTS_0", .components = 4, .storage = {ComponentType::uint8, false}};
    Attribute weights = {.name = "WEIGHTS_0", .components = 4};
    Attribute lift = {.name = "POSITION", .components = 3};
    for (const uint32_t vertex : mesh.wedge_vertex) {
        const float x = mesh.positions[vertex].x / 4;
        joints.values.insert(joints.values.end(), {0, 1, 0, 0});
        weights.values.insert(weights.values.end(), {1 - x, x, 0, 0});
        lift.values.insert(lift.values.end(), {0, x * x, 0});
    }
    mesh.attributes.push_back(std::move(joints));
    mesh.attributes.push_back(std::move(weights));
    mesh.morph_targets.push_back({{std::move(lift)}});
    return mesh;
}

Mesh blob(Blob shape) {
    Builder builder;
    builder.normals = true;
    builder.uvs = shape.uvs;
    const auto radius = [](Vec3d n) {
        return 1 + 0.15 * std::sin(5 * n.x + 1) * std::cos(4 * n.y) + 0.1 * std::sin(7 * n.z + 2 * n.x);
    };
    const auto surface = [&](Vec3d n) { return n * radius(n); };
    const auto at = [&](uint32_t i, uint32_t j) {
        Point p = on_sphere(i, j, shape.segments, shape.rings, 1);
        const Vec3d n = p.normal;
        const Vec3d side =
            normalized(std::abs(n.y) < 0.9 ? cross(Vec3d{0, 1, 0}, n) : cross(Vec3d{1, 0, 0}, n));
        const Vec3d up = cross(n, side);
        const double h = 1e-4;
        p.position = surface(n);
        p.normal = normalized(cross(surface(normalized(n + side * h)) - p.position,
                                    surface(normalized(n + up * h)) - p.position));
        return p;
    };
    tile_sphere(shape.segments, shape.rings, at, [&](Point a, Point b, Point c, uint32_t column) {
        // A pole belongs to every column: it takes the middle of each triangle's.
        for (Point* p : {&a, &b, &c}) {
            if (p->v == 0 || p->v == 1) p->u = (column + 0.5) / shape.segments;
        }
        builder.triangle(a, b, c);
    });
    return builder.finish();
}

}  // namespace coppice::shapes
