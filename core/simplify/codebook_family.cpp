#include "core/simplify/codebook_family.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace coppice {

namespace {

constexpr double most_cells = 64;  // along an axis, as n and xyz have at most

}  // namespace

CodebookFamily::CodebookFamily(const ParameterValues& values, const Bounds& box)
    : uniform_(values.text("schema") == "uniform") {
    const std::string_view xyz = values.text("xyz");
    if (uniform_) {
        given_ = values.number("n").has_value();
        start_ = values.number("n").value_or(5);
    } else if (!xyz.empty()) {
        given_ = true;
        take(xyz);
    } else {
        given_ = values.number("codebook_size").has_value();
        fit(box);
        start_ = largest_with(values.number("codebook_size").value_or(150));
    }
}

CodebookSizes CodebookFamily::sizes(double largest) const {
    CodebookSizes sizes{};
    for (size_t k = 0; k < 3; ++k)
        sizes[k] = static_cast<uint32_t>(std::max(1.0, std::round(largest * proportions_[k])));
    return sizes;
}

double CodebookFamily::threshold(const CodebookSizes& sizes) const {
    return uniform_ ? sizes[0] : static_cast<double>(code_vector_count(sizes));
}

// "5-4-3"
void CodebookFamily::take(std::string_view text) {
    for (double& p : proportions_) {
        p = std::stod(std::string(text));
        text.remove_prefix(std::min(text.find('-'), text.size() - 1) + 1);
    }
    start_ = *std::max_element(proportions_.begin(), proportions_.end());
    for (double& p : proportions_) p /= start_;
}

void CodebookFamily::fit(const Bounds& box) {
    if (box.empty()) return;
    const Vec3d edges = box.max - box.min;
    const double longest = std::max({edges.x, edges.y, edges.z});
    if (longest > 0) proportions_ = {edges.x / longest, edges.y / longest, edges.z / longest};
}

// By bisection: code-vectors do not get fewer. Not the last number that rounds so, since who calculates with
// it may come out beside it.
double CodebookFamily::largest_with(double code_vectors) const {
    double low = 1, high = std::min(code_vectors, most_cells);
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (static_cast<double>(code_vector_count(sizes(middle))) <= code_vectors ? low : high) = middle;
    }
    return low * (1 - 1e-9);
}

}  // namespace coppice
