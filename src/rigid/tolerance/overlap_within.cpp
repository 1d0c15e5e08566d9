#include "rigid/tolerance/overlap_within.h"

#include "rigid/model/solid.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/tolerance/ball_centres.h"
#include "rigid/tolerance/faces_in_reach.h"
#include "rigid/tolerance/known_side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// A vertex of the surface.
Vec3 origin_of(const WorldSolid& surface) {
    const std::vector<Vec3> points = surface.component_points();
    return points.empty() ? Vec3{} : points[0];
}

/// Both surfaces in a frame with a common origin near them, and the rounding there.
struct SeenPair {
    SeenPair(const WorldSolid& a, const WorldSolid& b)
        : rounding(rounding_of_lengths(a, b)), seen_a(a.seen_from(origin_of(a))),
          seen_b(b.seen_from(origin_of(a))), origin(origin_of(a)) {}

    double rounding;
    std::unique_ptr<const WorldSolid> seen_a, seen_b;
    Vec3 origin;
};

/// A proof; if it fails, a point that shows it.
struct Answer {
    Proof proof = Proof::holds;
    Vec3 found{};
};

FacePolygon polygon_of(const Triangle& t) {
    return {t[0], t[1], t[2]};
}

/// All vertices; none if there are more than are worth a look.
std::vector<Vec3> vertices_of(const WorldSolid& surface) {
    constexpr std::size_t kMostVertices = 16384;
    std::vector<Vec3> vertices;
    surface.for_each_block(surface.world_box(), [&](const WorldSolid::Block& block) {
        const std::size_t count = block.model.data().mesh().positions.size();
        if (vertices.size() + count > kMostVertices) {
            vertices.clear();
            return false;
        }
        for (std::uint32_t i = 0; i < count; ++i)
            vertices.push_back(block.model.world_vertex(i));
        return true;
    });
    return vertices;
}

/// Planes over which no point of a solid is farther than `limit` from its surface: they touch it, and
/// are then moved inward by the limit.
std::vector<CuttingPlane> bounds_of_depth(const WorldSolid& solid, std::span<const Vec3> directions,
                                          double limit) {
    std::vector<CuttingPlane> bounds;
    const std::vector<Vec3> vertices = vertices_of(solid);
    if (vertices.empty())
        return bounds;
    for (const Vec3& direction : directions) {
        const Vec3 along = normalized_or_zero(direction);
        const auto height = [&](const Vec3& p) { return dot(p - vertices[0], along); };
        const auto [lowest, highest] = std::ranges::minmax(vertices, {}, height);
        if (along == Vec3{})
            continue;
        bounds.push_back({highest - limit * along, along});
        bounds.push_back({lowest + limit * along, -along});
    }
    return bounds;
}

/// Searches for the deepest point of a surface in a solid, deeper than a limit.
SolidDepth deepest_of(const WorldSolid& surface, const WorldSolid& solid, double limit,
                      double rounding, const ToleranceSearch& options) {
    constexpr double kRaise = 0x1p-20; // docs/decisions/0003 measures others
    ReachSearch search(solid, {.limit = limit,
                               .raise = kRaise,
                               .rounding = rounding,
                               .bounds = bounds_of_depth(solid, options.directions, limit),
                               .budget = options.budget});
    for_each_face_in_reach(surface, grown(solid.world_box(), rounding), 0, search,
                           [&](const Triangle& face, std::uint32_t) {
                               return search.add(polygon_of(face)) == Proof::holds;
                           });
    return {search.depth(),
            search.proof() == Proof::holds ? search.limit()
                                           : std::numeric_limits<double>::infinity(),
            search.counterexample()};
}

Answer all_points_pass(const WorldSolid& surface, const WorldSolid& solid,
                       const ReachSearch::Options& options) {
    ReachSearch search(solid, options);
    Box3 box =
        grown(options.both_sides ? surface.world_box() : solid.world_box(), options.rounding);
    for_each_face_in_reach(surface, box, 0, search, [&](const Triangle& face, std::uint32_t) {
        return search.add(polygon_of(face)) == Proof::holds;
    });
    return {search.proof(), search.counterexample()};
}

/// Adds a face with its normal outward. If its weight does not tell which side is outside, points
/// close to the face tell: a face with the solid on neither side is touched by no ball in it, and one
/// with the solid on both sides is added both ways.
void add_turned_outward(const Triangle& face, int weight, const WorldSolid& solid, KnownSide& known,
                        std::vector<Triangle>& faces) {
    const Triangle turned{face[0], face[2], face[1]};
    if (weight != 0)
        return faces.push_back(weight < 0 ? turned : face);
    const auto is_in = [&](const Vec3& point) {
        return !solid.on_surface(point) && is_inside(solid, point, known);
    };
    const FaceProbe probe = face_probe(face);
    if (is_in(probe.under))
        faces.push_back(face);
    if (is_in(probe.over))
        faces.push_back(turned);
}

/// Decides whether no ball that touches the surface of `touched` from inside lies in both.
Answer no_ball_touches(const WorldSolid& touched, const WorldSolid& other,
                       const ReachSearch::Options& options) {
    // By more than the rounding above the limit, so that a ball that touches nothing else is found.
    const double radius = options.limit * (1 + kCentreError) + 4 * options.rounding;
    ReachSearch search(other, options);
    std::vector<Triangle> faces;
    KnownSide known;
    const Box3 box = grown(other.world_box(), options.rounding);
    for_each_face_in_reach(
        touched, box, 2 * radius, search, [&](const Triangle& face, std::uint32_t number) {
            add_turned_outward(face, touched.weight(number), touched, known, faces);
            return true;
        });
    for_each_centre_polygon(
        faces, radius,
        [&](const FacePolygon& polygon) { return search.add(polygon) == Proof::holds; },
        [&](const Vec3& middle, double reach) {
            return search.rules_out_by_either(middle, reach);
        });
    return {search.proof(), search.counterexample()};
}

/// The proof of two statements together.
template <typename First, typename Second>
Answer both_pass(const First& first, const Second& second) {
    const Answer one = first();
    if (one.proof == Proof::fails)
        return one;
    const Answer other = second();
    return other.proof == Proof::holds ? one : other;
}

} // namespace

double rounding_of_lengths(const WorldSolid& a, const WorldSolid& b) {
    const double far = max_abs(a.middle()) + a.reach() + max_abs(b.middle()) + b.reach();
    return depth_rounding(a, b) + 0x1p-50 * far;
}

Proof nowhere_deeper(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                     Vec3* found) {
    const SeenPair seen(a, b);
    const auto in = [&](const WorldSolid& surface, const WorldSolid& solid) {
        if (!solid.bounds_solid())
            return Answer{};
        return all_points_pass(
            surface, solid,
            {.limit = options.tolerance,
             .rounding = seen.rounding,
             .bounds = bounds_of_depth(solid, options.directions, options.tolerance),
             .budget = options.budget});
    };
    const Answer answer = both_pass([&] { return in(*seen.seen_a, *seen.seen_b); },
                                    [&] { return in(*seen.seen_b, *seen.seen_a); });
    if (found != nullptr)
        *found = seen.origin + answer.found;
    return answer.proof;
}

SolidDepth solid_depth(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                       double known) {
    const SeenPair seen(a, b);
    const double least = std::max(known, options.tolerance);
    SolidDepth best{0, least, {}};
    const auto look = [&](const WorldSolid& surface, const WorldSolid& solid) {
        if (!solid.bounds_solid())
            return;
        const SolidDepth found =
            deepest_of(surface, solid, std::max(least, best.depth), seen.rounding, options);
        if (found.depth > best.depth)
            best.depth = found.depth, best.point = seen.origin + found.point;
        best.at_most = std::max(best.at_most, found.at_most);
    };
    look(*seen.seen_a, *seen.seen_b);
    look(*seen.seen_b, *seen.seen_a);
    return best;
}

Proof nowhere_thicker(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                      Vec3* found) {
    const SeenPair seen(a, b);
    const auto touching = [&](const WorldSolid& touched, const WorldSolid& other) {
        const double radius = 0.5 * options.tolerance;
        std::vector<CuttingPlane> bounds = bounds_of_depth(other, options.directions, radius);
        for (const CuttingPlane& bound : bounds_of_depth(touched, options.directions, radius))
            bounds.push_back(bound);
        return no_ball_touches(touched, other,
                               {.limit = radius,
                                .rounding = seen.rounding,
                                .own = &touched,
                                .bounds = std::move(bounds),
                                .budget = options.budget});
    };
    const Answer answer = both_pass([&] { return touching(*seen.seen_a, *seen.seen_b); },
                                    [&] { return touching(*seen.seen_b, *seen.seen_a); });
    if (found != nullptr)
        *found = seen.origin + answer.found;
    return answer.proof;
}

Proof everywhere_near(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options) {
    const SeenPair seen(a, b);
    const ReachSearch::Options search{.limit = options.tolerance,
                                      .rounding = seen.rounding,
                                      .both_sides = true,
                                      .budget = options.budget};
    return both_pass([&] { return all_points_pass(*seen.seen_a, *seen.seen_b, search); },
                     [&] { return all_points_pass(*seen.seen_b, *seen.seen_a, search); })
        .proof;
}

bool extents_overlap_little(const WorldSolid& a, const WorldSolid& b,
                            std::span<const Vec3> directions, double tolerance) {
    const double allowed = tolerance + rounding_of_lengths(a, b);
    const std::vector<Vec3> of_a = vertices_of(a), of_b = vertices_of(b);
    if (of_a.empty() || of_b.empty())
        return false;
    return std::ranges::any_of(directions, [&](const Vec3& direction) {
        const Vec3 along = normalized_or_zero(direction);
        const auto height = [&](const Vec3& p) { return dot(p - of_a[0], along); };
        const auto [low_a, high_a] = std::ranges::minmax(of_a, {}, height);
        const auto [low_b, high_b] = std::ranges::minmax(of_b, {}, height);
        return along != Vec3{} && (height(high_a) - height(low_b) <= allowed ||
                                   height(high_b) - height(low_a) <= allowed);
    });
}

} // namespace abut
