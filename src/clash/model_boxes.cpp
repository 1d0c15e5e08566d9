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

std::vector<std::string> ask_about_lengths(const ClashOptions& options,
                                           const std::vector<Box3>& boxes) {
    double size = 0;
    for (const Box3& box : boxes)
        size = std::max({size, box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                         box.upper.z - box.lower.z});
    std::vector<std::string> questions;
    const auto look_at = [&](const std::string& what, double length) {
        constexpr double kHalf = 2, kTenth = 10, kMetre = 1;
        const bool is_long =
            kHalf * length >= size || (length >= kMetre && kTenth * length >= size);
        if (size > 0 && length > 0 && is_long)
            questions.push_back(fmt::format("{} of {:.6g} m: did you mean {:.6g}mm? The largest "
                                            "model measures {}",
                                            what, length, length, length_text(size)));
    };
    look_at("a clearance", options.clearance);
    look_at("a touch tolerance", options.touch_tolerance.value_or(0));
    const auto look_at_rule = [&](const ClashRule& rule) {
        const std::string of = "rule \"" + rule.name + "\": a ";
        look_at(of + "clearance", rule.clearance.value_or(0));
        look_at(of + "touch tolerance", rule.touch_tolerance.value_or(0));
        look_at(of + "tolerated depth", rule.tolerated_depth.value_or(0));
    };
    std::ranges::for_each(options.rules, look_at_rule);
    for (const ClashMatrix::Cell& cell : options.matrix.cells)
        look_at_rule(cell.terms);
    return questions;
}

} // namespace abut
