// The codebooks that a run of GAEA may have: grids in fixed proportions, from coarse to fine.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/mesh/bounds.h"
#include "core/simplify/codebook.h"
#include "core/simplify/parameter.h"

namespace coppice {

class CodebookFamily {
  public:
    // schema=uniform: n along each axis. schema=xyz: in the proportions of `xyz`, or else of the box, from
    // which the paper derives them by "a pre-determined filter": each as many as its edge, at least 1.
    CodebookFamily(const ParameterValues& values, const Bounds& box);

    // Members are named by the cells along the axis with the most.
    CodebookSizes sizes(double largest) const;

    // The one that parameters name, or 5 or 150 code-vectors, where the paper starts its iterations.
    double start() const { return start_; }
    bool is_given() const { return given_; }

    // In the unit of the parameter that names it: n, or codebook_size.
    double threshold(const CodebookSizes& sizes) const;

  private:
    void take(std::string_view text);
    void fit(const Bounds& box);
    double largest_with(double code_vectors) const;

    bool uniform_;
    std::array<double, 3> proportions_ = {1, 1, 1};  // the largest is 1
    double start_ = 5;
    bool given_ = false;
};

}  // namespace coppice
