#include "suites/machine_parts.h"

#include "scenes/deforming/frame.h"
#include "scenes/shapes.h"

#include <array>

namespace abut::bench {

namespace {

using scenes::Point2;

/// A prism whose outline alternates between two radii.
Mesh toothed(double length, int teeth, int points, double inner, double outer) {
    std::vector<Point2> outline;
    for (int i = 0; i < teeth * points; ++i) {
        const Point2 c = scenes::on_circle(i, teeth * points);
        const double r = i % points < points / 2 ? outer : inner;
        outline.push_back({r * c.u, r * c.v});
    }
    return scenes::prism(length, outline).mesh;
}

/// Boxes on a circle that do not touch each other.
Mesh ring_of_boxes(int count) {
    scenes::Shape ring;
    for (int i = 0; i < count; ++i) {
        const Point2 c = scenes::on_circle(i, count);
        const scenes::Shape box =
            scenes::box({{c.u - 0.08, c.v - 0.08, -0.08}, {c.u + 0.08, c.v + 0.08, 0.08}});
        scenes::append(ring, box, Transform());
    }
    return ring.mesh;
}

Mesh perforated_plate() {
    const std::vector<double> cuts{0, 1, 2, 3, 4, 5, 6, 7};
    return scenes::plate(cuts, cuts, 0, 0.5,
                         [](std::size_t x, std::size_t z) { return x % 2 == 0 || z % 2 == 0; })
        .mesh;
}

} // namespace

std::vector<NamedMesh> machine_parts() {
    return {
        {"bracket",
         scenes::prism(1, {{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}).mesh},
        {"I-section", scenes::i_section(1, 0.3, 0.2, 0.02, 0.03).mesh},
        {"flanged pipe", scenes::pipe(1, 0.1, 32, {0.2, 0.2}).mesh},
        {"star", toothed(0.4, 7, 2, 0.5, 1)},
        {"gear", toothed(0.4, 24, 4, 0.85, 1)},
        {"perforated plate", perforated_plate()},
        {"ring of boxes", ring_of_boxes(24)},
        {"elbow", scenes::elbow(0.1, 0.5, 24, 16).mesh},
    };
}

} // namespace abut::bench
