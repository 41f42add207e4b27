// The scenes of the ITS paper and what it printed of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/papers/models.h"

namespace coppice::papers {

// The four that its Table 3 sets side by side, in that order.
enum Contender { quadric, gaps, ias, its, count_contenders };
constexpr std::array<const char*, count_contenders> contender_names = {"quadric", "gaps", "ias", "its"};

// Of one scene at one level: its Tables 2 and 3, and the times in the text and captions of Figures 3 to 6.
struct Printed {
    double removed;
    double vertices, triangles;                                    // of one mesh
    std::array<double, count_contenders> kilobytes, milliseconds;  // of the scene
    double figure_seconds;                                         // 0: none
};

struct PaperScene {
    std::string name;
    std::string figure;
    double vertices, texture_coordinates, normals, triangles;  // its Table 1
    uint32_t instances;
    double kilobytes_of_instance;
    Model model;  // ours
    std::vector<Printed> printed;
};

std::vector<PaperScene> its_scenes();

}  // namespace coppice::papers
