#include "clash/model_boxes.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace abut {

namespace {

double gap_between(const Box3& a, const Box3& b) {
    const auto gap = [](double lower_a, double upper_a, double lower_b, double upper_b) {
        return std::max({0.0, lower_b - upper_a, lower_a - upper_b});
    };
    return std::hypot(gap(a.lower.x, a.upper.x, b.lower.x, b.upper.x),
                      gap(a.lower.y, a.upper.y, b.lower.y, b.upper.y),
                      gap(a.lower.z, a.upper.z, b.lower.z, b.upper.z));
}

} // namespace

std::string length_text(double metres) {
    return metres >= 1000 ? fmt::format("{:.3g} km", metres / 1000)
                          : fmt::format("{:.3g} m", metres);
}

std::vector<std::string> warn_of_distant_models(const std::vector<std::string>& files,
                                                const std::vector<Box3>& boxes, double clearance) {
    // Grows a minimum spanning tree of the gaps from the first model. The edges of the tree that
    // are longer than the clearance separate the groups.
    constexpr double kFar = std::numeric_limits<double>::infinity();
    struct Outside {
        std::size_t model, nearest;
        double gap;
    };
    std::vector<Outside> outside;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].lower.x <= boxes[i].upper.x)
            outside.push_back({i, i, kFar});
    std::vector<std::string> warnings;
    while (!outside.empty()) {
        const auto next = std::ranges::min_element(outside, {}, &Outside::gap);
        const Outside joined = *next;
        outside.erase(next);
        if (joined.gap > clearance && joined.gap < kFar)
            warnings.push_back(
                fmt::format("the boxes of {} and {} are {} apart: they share no space",
                            files[joined.nearest], files[joined.model], length_text(joined.gap)));
        for (Outside& other : outside)
            if (const double gap = gap_between(boxes[joined.model], boxes[other.model]);
                gap < other.gap) {
                other.gap = gap;
                other.nearest = joined.model;
            }
    }
    return warnings;
}

} // namespace abut
