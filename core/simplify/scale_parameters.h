// What one unit of each attribute weighs: parameters that gaps and its share.
#pragma once

#include "core/simplify/attribute_cloud.h"
#include "core/simplify/parameter.h"

namespace coppice {

inline Parameter normal_scale_parameter() {
    return {.id = "normal_scale",
            .title = "what one unit of normals weighs; 0.05 of the mesh's diagonal unless given",
            .unit = "mesh units",
            .minimum = 0};
}

inline Parameter uv_scale_parameter() {
    return {
        .id = "uv_scale",
        .title = "what one unit of texture coordinates weighs; sqrt(area / area in the texture) unless given",
        .unit = "mesh units",
        .minimum = 0};
}

inline Parameter color_scale_parameter() {
    return {.id = "color_scale",
            .title = "what one unit of colours weighs; 0.05 of the mesh's diagonal unless given",
            .unit = "mesh units",
            .minimum = 0};
}

inline AttributeScales attribute_scales(const ParameterValues& values) {
    return {values.number("normal_scale"), values.number("uv_scale"), values.number("color_scale")};
}

}  // namespace coppice
