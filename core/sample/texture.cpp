#include "core/sample/texture.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/base/random.h"

namespace coppice {

Bytes draw_png(uint32_t size, const std::function<Rgb(double u, double v)>& colour) {
    std::vector<uint8_t> pixels;
    pixels.reserve(size_t{3} * size * size);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            for (const double channel : colour((x + 0.5) / size, (y + 0.5) / size)) {
                pixels.push_back(static_cast<uint8_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0))));
            }
        }
    }
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = size;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t length = 0;
    Bytes out;
    bool done = png_image_write_get_memory_size(image, length, 0, pixels.data(), 0, nullptr) != 0;
    if (done) {
        out.resize(length);
        done = png_image_write_to_memory(&image, out.data(), &length, 0, pixels.data(), 0, nullptr) != 0;
        out.resize(length);
    }
    require(done, ErrorCode::internal, "", "libpng could not write a texture: {}", image.message);
    return out;
}

double noise(double u, double v, uint32_t cells, uint64_t seed) {
    const auto lattice = [&](uint32_t x, uint32_t y) {
        return Random(seed * 1'000'003 + (x % cells) * 7919ULL + (y % cells) * 104'729ULL).uniform();
    };
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const double x = (u - std::floor(u)) * cells, y = (v - std::floor(v)) * cells;
    const auto x0 = static_cast<uint32_t>(x), y0 = static_cast<uint32_t>(y);
    const double fx = ease(x - x0), fy = ease(y - y0);
    const double top = std::lerp(lattice(x0, y0), lattice(x0 + 1, y0), fx);
    const double bottom = std::lerp(lattice(x0, y0 + 1), lattice(x0 + 1, y0 + 1), fx);
    return std::lerp(top, bottom, fy);
}

uint32_t add_material(Scene& scene, const Paint& paint) {
    const auto image = static_cast<uint32_t>(scene.images.size());
    scene.images.push_back({.name = paint.name,
                            .mime_type = "image/png",
                            .path = paint.name + ".png",
                            .bytes = draw_png(paint.size, paint.colour)});
    Material material;
    material.name = paint.name;
    material.metallic = paint.metallic;
    material.roughness = paint.roughness;
    material.double_sided = paint.double_sided;
    material.base_color_texture.image = image;
    scene.materials.push_back(std::move(material));
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

}  // namespace coppice
