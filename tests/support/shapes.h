// Meshes drawn for tests: small, exact, with known borders and seams. All are consistent and welded: one
// vertex per position, one wedge per distinct set of attributes, unless a name says otherwise.
#pragma once

#include <cstdint>

#include "core/mesh/mesh.h"

namespace coppice::shapes {

struct Sphere {
    uint32_t segments = 24;  // around
    uint32_t rings = 12;     // from pole to pole
    double radius = 1;
    bool normals = true;
    uint32_t materials = 1;  // slots, as bands from pole to pole; closed without gaps
};
Mesh sphere(Sphere shape = {});

// Along y, open at both ends: two borders.
struct Cylinder {
    uint32_t segments = 24;
    uint32_t rows = 8;
    bool normals = true;
    bool seam = true;  // UVs 0..1 around, which break along one line of edges
};
Mesh cylinder(Cylinder shape = {});

// In the xz plane over [0, 1]^2, facing +y: one border. With height, gentle hills.
struct Grid {
    uint32_t columns = 16, rows = 16;
    double height = 0;
    bool normals = false;
    bool uvs = false;
    bool colors = false;  // COLOR_0, red along x
};
Mesh grid(Grid shape = {});

// Square sheets with gaps between them, side by side in the xz plane, facing +y: none is connected to
// another.
struct Tiles {
    uint32_t columns = 8, rows = 8;
    uint32_t cells = 1;  // squares along each side of a tile
    double gap = 0.1;    // of the distance between the centres of tiles, which is 1
    bool uvs = false;    // 0..1 over each tile
};
Mesh tiles(Tiles shape = {});

struct Torus {
    uint32_t segments = 32, sides = 16;
    double radius = 1, thickness = 0.4;
};
Mesh torus(Torus shape = {});  // normals

// A cube of edge 1 with `cells` squares along each edge. Faceted: every side has its own normal, so the
// twelve edges are seams of normals, and nothing else.
struct Box {
    uint32_t cells = 4;
    bool faceted = true;  // else no attributes at all
};
Mesh box(Box shape = {});

// A sphere where each triangle has its own normal (and colour): every edge is a break of them.
Mesh faceted_sphere(uint32_t segments = 24, uint32_t rings = 12);

Mesh tetrahedron();  // no attributes

// Triangles without order: they cross, and share vertices by chance. The same for the same seed.
Mesh soup(uint32_t triangles = 300, uint32_t seed = 1);

// A flat grid with a wall standing on its middle line: edges with three triangles.
Mesh fin(uint32_t cells = 8);

// A ribbon along x with JOINTS_0 and WEIGHTS_0 blending from joint 0 to 1, TEXCOORD_0, and a morph target
// that lifts it.
Mesh skinned_strip(uint32_t cells = 24);

// An organic closed mesh: a sphere with bumps, 2 * (vertices - 2) triangles, with normals and UVs that break
// along one line from pole to pole. vertices: 2 + segments * (rings - 1).
struct Blob {
    uint32_t segments = 61, rings = 42;  // 2503 vertices, as many as the bunny of the ITS paper
    bool uvs = true;
};
Mesh blob(Blob shape = {});

}  // namespace coppice::shapes
