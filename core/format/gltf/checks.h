// The rules of glTF that tie objects together, one function per part of the document. Each relies on
// check_schema, and on what stands above it here. All throw asset_malformed with a JSON pointer; what is
// repaired is a warning instead.
#pragma once

#include "core/base/watch.h"
#include "core/format/gltf/parsed.h"
#include "core/format/limits.h"

namespace coppice::gltf {

// Version, and what extensionsRequired demands. Throws asset_unsupported, asset_extension_unsupported.
void check_asset(const Json& document);
void check_extensions(Parsed& parsed, const Watch& watch);
// Names the unknown extensions that hold integers, which may be indices of anything.
std::vector<std::string> extensions_with_unknown_indices(const Json& document);

// How many there are of everything: relies on nothing, as it keeps all other checks short.
void check_counts(const Json& document, const ReadLimits& limits);
// What meshes and accessors say that they hold, before a byte of it is looked at or made.
void check_claims(const Json& document, const ReadLimits& limits, const Watch& watch);

void check_nodes(Parsed& parsed, const ReadLimits& limits, const Watch& watch);
void check_skins(Parsed& parsed, const ReadLimits& limits, const Watch& watch);
void check_meshes(Parsed& parsed, const Watch& watch);
void check_materials(Parsed& parsed, const Watch& watch);
void check_cameras_and_lights(const Parsed& parsed);
void check_animations(Parsed& parsed, const Watch& watch);
void check_instancing(Parsed& parsed, const Watch& watch);

// What the values of vertex attributes must be: needs everything above. Primitives that Draco compressed are
// skipped.
void check_vertex_data(Parsed& parsed, const ReadLimits& limits, const Watch& watch);

// Marks what an accessor is read as. Throws where it was something else before.
void set_usage(Parsed& parsed, uint32_t accessor, Usage usage, const Pointer& where);
void set_view_usage(Parsed& parsed, uint32_t view, ViewUsage usage, const Pointer& where);

}  // namespace coppice::gltf
