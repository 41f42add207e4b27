// Textures drawn by a function, and the materials that use them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "core/scene/scene.h"

namespace coppice {

using Rgb = std::array<double, 3>;  // 0..1, as stored (sRGB)

// An 8-bit PNG of size x size pixels; colour(u, v) is asked at pixel centres.
Bytes draw_png(uint32_t size, const std::function<Rgb(double u, double v)>& colour);

// Smooth noise in 0..1 with about `cells` bumps across, tileable over 0..1.
double noise(double u, double v, uint32_t cells, uint64_t seed);

struct Paint {
    std::string name;
    float metallic = 0;
    float roughness = 0.9F;
    bool double_sided = false;
    uint32_t size = 128;
    std::function<Rgb(double u, double v)> colour;
};

// Adds an image and a material that shows it -> the material's index.
uint32_t add_material(Scene& scene, const Paint& paint);

}  // namespace coppice
