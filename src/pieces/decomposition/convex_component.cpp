#include "pieces/decomposition/convex_component.h"

#include "convex/hull/exact_hull.h"
#include "convex/hull/polytope.h"
#include "math/predicates.h"

#include <algorithm>

namespace abut {

namespace {

/// The components of the surface: triangles connected by edges. Triangles with two equal corners
/// are in none.
std::vector<std::vector<std::uint32_t>> components(const SurfaceGraph& surface) {
    std::vector<std::vector<std::uint32_t>> result;
    std::vector<bool> seen(surface.corners.size());
    for (std::uint32_t first = 0; first < seen.size(); ++first) {
        if (seen[first] || surface.across[first][0] == kNoEdge)
            continue;
        std::vector<std::uint32_t> component{first};
        seen[first] = true;
        for (std::size_t i = 0; i < component.size(); ++i)
            for (const std::uint32_t t : surface.across[component[i]])
                if (!seen[t]) {
                    seen[t] = true;
                    component.push_back(t);
                }
        result.push_back(std::move(component));
    }
    return result;
}

class ConvexityTest {
public:
    ConvexityTest(const PlacedModel& model, const SurfaceGraph& surface)
        : model_(model), surface_(surface), number_(surface.positions.size(), kNoEdge) {}

    bool operator()(const std::vector<std::uint32_t>& component) {
        // Most dents are found between neighbours, without a hull.
        for (const std::uint32_t t : component)
            for (const std::uint32_t u : surface_.across[t])
                for (const std::uint32_t v : surface_.corners[u])
                    if (side(t, surface_.positions[v]) > 0)
                        return false;
        std::vector<Vec3> points;
        std::vector<std::uint32_t> used;
        for (const std::uint32_t t : component)
            for (const std::uint32_t v : surface_.corners[t])
                if (number_[v] == kNoEdge) {
                    number_[v] = static_cast<std::uint32_t>(points.size());
                    used.push_back(v);
                    points.push_back(surface_.positions[v]);
                }
        const bool convex = lies_on_hull(component, points);
        for (const std::uint32_t v : used)
            number_[v] = kNoEdge;
        return convex && is_alone(component, points);
    }

private:
    [[nodiscard]] int side(std::uint32_t plane, const Vec3& p) const {
        const Triangle t = surface_.triangle(plane);
        return orient3d(t[0], t[1], t[2], p);
    }

    [[nodiscard]] bool lies_on_hull(const std::vector<std::uint32_t>& component,
                                    const std::vector<Vec3>& points) const {
        HullSurface hull = exact_hull(points);
        if (hull.dimension < 3)
            return false;
        std::vector<std::uint32_t> vertex(points.size(), kNoEdge);
        std::vector<Vec3> corners;
        for (const std::uint32_t p : hull.vertices) {
            vertex[p] = static_cast<std::uint32_t>(corners.size());
            corners.push_back(points[p]);
        }
        for (IndexTriangle& t : hull.triangles)
            for (std::uint32_t& v : t)
                v = vertex[v];
        const Polytope polytope = make_polytope(corners, hull.triangles);
        return std::all_of(component.begin(), component.end(), [&](std::uint32_t t) {
            const Vec3* at = nullptr;
            for (const std::uint32_t c : surface_.corners[t]) {
                const std::uint32_t v = vertex[number_[c]];
                if (v == kNoEdge)
                    continue;
                // No neighbour of the corner is in front of the plane, so no vertex is.
                at = &polytope.vertices[v].at;
                const HullVertex& h = polytope.vertices[v];
                for (std::uint32_t e = h.first_edge; e < h.first_edge + h.degree; ++e)
                    if (side(t, polytope.to(e)) > 0)
                        return false;
                break;
            }
            return at != nullptr || std::all_of(corners.begin(), corners.end(),
                                                [&](const Vec3& p) { return side(t, p) <= 0; });
        });
    }

    /// Returns whether the component's box holds no other triangle.
    [[nodiscard]] bool is_alone(const std::vector<std::uint32_t>& component,
                                const std::vector<Vec3>& points) const {
        if (component.size() == surface_.corners.size())
            return true;
        Box3 box;
        for (const Vec3& p : points)
            extend(box, p);
        std::vector<std::uint32_t> sorted = component;
        std::sort(sorted.begin(), sorted.end());
        bool alone = true;
        model_.for_each_overlap(box, [&](std::uint32_t slot) {
            alone = alone && std::binary_search(sorted.begin(), sorted.end(),
                                                model_.data().triangle_at(slot));
        });
        return alone;
    }

    const PlacedModel& model_;
    const SurfaceGraph& surface_;
    std::vector<std::uint32_t> number_; ///< of each vertex in the component
};

} // namespace

std::vector<std::vector<std::uint32_t>> convex_components(const PlacedModel& model,
                                                          const SurfaceGraph& surface) {
    std::vector<std::vector<std::uint32_t>> result;
    ConvexityTest is_convex(model, surface);
    for (std::vector<std::uint32_t>& component : components(surface))
        if (is_convex(component))
            result.push_back(std::move(component));
    return result;
}

} // namespace abut
