// The algorithms of the registry in every mode that they have, for what must hold for all of them.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/registry.h"

namespace coppice::test {

// An algorithm with values for some of its parameters.
struct Variant {
    std::string algorithm;
    std::map<std::string, ParameterValue> parameters = {};
};
std::ostream& operator<<(std::ostream& out, const Variant& variant);

// "its_mode_faithful_sphere", for the names of parameterized tests.
std::string test_name(const Variant& variant, const std::string& shape);

// Every algorithm as it is by default, and with other modes that guard the surface too.
std::vector<Variant> variants();

// Those that run as their papers print them: they may fold and close the surface, but nothing else.
std::vector<Variant> unguarded_variants();

// Both.
std::vector<Variant> all_variants();

// The mesh stands once, where the algorithm weighs the meshes of a scene.
Simplified simplify(const Variant& variant, const Mesh& mesh, const Target& target, const Watch& watch = {});

Target part_of(const Mesh& mesh, double ratio);

}  // namespace coppice::test
