#include <abut/shape_queries.h>

#include "core/stop.h"
#include "geometry/box_triangle_intersect.h"
#include "geometry/sphere_triangle_intersect.h"
#include "geometry/triangle_triangle_intersect.h"
#include "rigid/shapes/shape_arguments.h"
#include "rigid/solid/placed_solid.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

using Triangles = std::vector<std::uint32_t>;

/// How many of the triangles that meet a shape are wanted: one or all.
enum class Wanted : std::uint8_t { one, all };

/// Collects the triangles for which `meets` holds, until there are enough.
template <typename Meets>
class Collector {
public:
    Collector(const PlacedModel& model, Wanted wanted, const Meets& meets)
        : model_(model), wanted_(wanted), meets_(meets) {}

    void operator()(std::uint32_t slot) {
        if (!enough() && meets_(model_.world_slot(slot)))
            found.push_back(model_.data().triangle_at(slot));
    }
    [[nodiscard]] bool enough() const { return wanted_ == Wanted::one && !found.empty(); }

    Triangles found;

private:
    const PlacedModel& model_;
    Wanted wanted_;
    const Meets& meets_;
};

Triangles find(const PlacedModel& model, const Sphere& sphere, Wanted wanted) {
    require_sphere(sphere);
    const auto meets = [&](const Triangle& t) {
        return sphere_triangle_intersect(sphere.centre, sphere.radius, t);
    };
    Collector collect(model, wanted, meets);
    const double bound_sq = sphere.radius * sphere.radius;
    model.for_each_near(sphere.centre, bound_sq, [&](std::uint32_t slot) {
        collect(slot);
        return collect.enough() ? kStopTraversal : bound_sq;
    });
    return std::move(collect.found);
}

Triangles find(const PlacedModel& model, const Box3& box, Wanted wanted) {
    if (!require_box(box))
        return {};
    const auto meets = [&](const Triangle& t) { return box_triangle_intersect(box, t); };
    Collector collect(model, wanted, meets);
    model.for_each_overlap(box, [&](std::uint32_t slot) { collect(slot); });
    return std::move(collect.found);
}

Triangles find(const PlacedModel& model, const Segment& segment, Wanted wanted) {
    require_segment(segment);
    const Triangle as_triangle{segment.a, segment.b, segment.b};
    const auto meets = [&](const Triangle& t) {
        return triangle_triangle_intersect(as_triangle, t) != TriangleContact::none;
    };
    Collector collect(model, wanted, meets);
    model.for_each_on_segment(segment.a, segment.b, [&](std::uint32_t slot) { collect(slot); });
    return std::move(collect.found);
}

/// The twelve triangles that abut/shapes.h describes.
Mesh surface_of(const OrientedBox& box) {
    const Vec3 &low = box.box.lower, &high = box.box.upper;
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                          (i & 4U) != 0 ? high.z : low.z};
        mesh.positions.push_back(apply(box.world_from_box, corner));
        require_point(mesh.positions.back(), "oriented box");
    }
    for (const std::array<std::uint32_t, 4>& face : {std::array{0U, 2U, 3U, 1U},
                                                     {4U, 5U, 7U, 6U},
                                                     {0U, 1U, 5U, 4U},
                                                     {2U, 6U, 7U, 3U},
                                                     {0U, 4U, 6U, 2U},
                                                     {1U, 3U, 7U, 5U}}) {
        mesh.triangles.push_back({face[0], face[1], face[2]});
        mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    return mesh;
}

/// The half-spaces outside of the faces of a box. All corners lie behind them, to rounding, also
/// where a thin face far from the origin has a normal that is hardly better than noise. A face
/// without a clear outside gives none, and its normal is zero.
std::array<PlacedModel::HalfSpace, 6> outsides_of(const Mesh& box) {
    std::array<PlacedModel::HalfSpace, 6> outsides;
    const Vec3 middle = 0.5 * (box.positions[0] + box.positions[7]);
    for (std::size_t face = 0; face < 6; ++face) {
        const auto& t = box.triangles[2 * face];
        const Vec3 &p = box.positions[t[0]], &q = box.positions[t[1]], &r = box.positions[t[2]];
        Vec3 normal = normalized_or_zero(cross(q - p, r - p));
        const double out = dot(normal, p - middle);
        if (!(std::abs(out) > 0x1p-20 * (length(q - p) + length(r - p))))
            continue;
        if (out < 0)
            normal = -normal;
        const Vec3 farthest = *std::max_element(
            box.positions.begin(), box.positions.end(), [&](const Vec3& a, const Vec3& b) {
                return dot(normal, a - middle) < dot(normal, b - middle);
            });
        outsides[face] = {farthest, normal};
    }
    return outsides;
}

Triangles find(const PlacedModel& model, const OrientedBox& box, Wanted wanted) {
    require_finite(box.world_from_box, "transform of the box");
    if (!require_box(box.box))
        return {};
    const Model surface(surface_of(box));
    // The box is closed also if corners coincide, which the parity of crossings allows.
    Solid solid;
    solid.closed = true;
    const PlacedSolid placed_box(surface, solid, {});
    Box3 bounds;
    for (const Vec3& p : surface.mesh().positions)
        extend(bounds, p);
    const auto meets = [&](const Triangle& t) {
        Box3 box_of_t;
        for (const Vec3& p : t)
            extend(box_of_t, p);
        if (!overlap(bounds, box_of_t))
            return false;
        bool meet = false;
        placed_box.model().for_each_overlap(box_of_t, [&](std::uint32_t slot) {
            meet = meet || triangle_triangle_intersect(placed_box.world_slot(slot), t) !=
                               TriangleContact::none;
        });
        // The triangle does not cross the box's surface: it lies all inside or all outside.
        return meet || placed_box.contains_off_surface(t[0]);
    };
    Collector collect(model, wanted, meets);
    // The first triangles tell the traversal, one by one, what lies outside of the box.
    const std::array<PlacedModel::HalfSpace, 6> outsides = outsides_of(surface.mesh());
    std::size_t told = 0;
    model.for_each_overlap_outside(bounds, [&](std::uint32_t slot) {
        collect(slot);
        return told < outsides.size() ? outsides[told++] : PlacedModel::HalfSpace{};
    });
    return std::move(collect.found);
}

template <typename Shape>
bool any(const Model& model, const Transform& world_from_model, const Shape& shape,
         const Progress& progress) {
    const StopScope stopping(progress);
    return !find(PlacedModel(model, world_from_model), shape, Wanted::one).empty();
}

template <typename Shape>
Triangles all(const Model& model, const Transform& world_from_model, const Shape& shape,
              const Progress& progress) {
    const StopScope stopping(progress);
    Triangles found = find(PlacedModel(model, world_from_model), shape, Wanted::all);
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

bool overlaps(const Model& model, const Transform& world_from_model, const Sphere& sphere,
              const Progress& progress) {
    return any(model, world_from_model, sphere, progress);
}
bool overlaps(const Model& model, const Transform& world_from_model, const Box3& box,
              const Progress& progress) {
    return any(model, world_from_model, box, progress);
}
bool overlaps(const Model& model, const Transform& world_from_model, const OrientedBox& box,
              const Progress& progress) {
    return any(model, world_from_model, box, progress);
}
bool overlaps(const Model& model, const Transform& world_from_model, const Segment& segment,
              const Progress& progress) {
    return any(model, world_from_model, segment, progress);
}

Triangles overlapping_triangles(const Model& model, const Transform& world_from_model,
                                const Sphere& sphere, const Progress& progress) {
    return all(model, world_from_model, sphere, progress);
}
Triangles overlapping_triangles(const Model& model, const Transform& world_from_model,
                                const Box3& box, const Progress& progress) {
    return all(model, world_from_model, box, progress);
}
Triangles overlapping_triangles(const Model& model, const Transform& world_from_model,
                                const OrientedBox& box, const Progress& progress) {
    return all(model, world_from_model, box, progress);
}
Triangles overlapping_triangles(const Model& model, const Transform& world_from_model,
                                const Segment& segment, const Progress& progress) {
    return all(model, world_from_model, segment, progress);
}

Gap distance(const Model& model, const Transform& world_from_model, const Segment& segment,
             const DistanceOptions& options) {
    require_segment(segment);
    // A segment as a model: one triangle without area.
    const Model as_model(Mesh{{segment.a, segment.b}, {{0, 1, 1}}});
    return distance(model, world_from_model, as_model, Transform(), options);
}

} // namespace abut
