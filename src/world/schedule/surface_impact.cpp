#include "world/schedule/surface_impact.h"

#include "deform/deformable_data.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// The first triangle that has all of these vertices.
std::uint32_t triangle_with(const DeformableData& data, std::span<const std::uint32_t> vertices) {
    const auto has_all = [&](const IndexTriangle& t) {
        return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
            return std::find(t.begin(), t.end(), v) != t.end();
        });
    };
    return static_cast<std::uint32_t>(
        std::find_if(data.triangles.begin(), data.triangles.end(), has_all) -
        data.triangles.begin());
}

/// A point of a feature, and a triangle to which the feature belongs.
struct FeaturePoint {
    Vec3 point;
    std::uint32_t triangle = 0;
};
FeaturePoint on_feature(const DeformableData& data, std::span<const std::uint32_t> vertices,
                        std::span<const double> weights, double time) {
    FeaturePoint result{{}, triangle_with(data, vertices)};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const MovingVertex& v = data.vertices[vertices[i]];
        result.point = result.point + weights[i] * ((1 - time) * v.start + time * v.end);
    }
    return result;
}

/// Upper bound of how long before the contact an exact time is reported.
constexpr double kTimeError = 1e-9;

Impact impact_of_features(const DeformableData& a, const DeformableData& b,
                          const FeatureImpact& found) {
    constexpr std::array kWhole{1.0};
    const auto on_edge = [&](const DeformableData& data, std::uint32_t edge, double s) {
        return on_feature(data, data.features.edges[edge], std::array{1 - s, s}, found.time);
    };
    FeaturePoint on_a, on_b;
    if (found.kind == ElementaryKind::edge_edge) {
        on_a = on_edge(a, found.a, found.barycentric[0]);
        on_b = on_edge(b, found.b, found.barycentric[1]);
    } else {
        const DeformableData &vertex_of = found.face_first ? b : a,
                             &face_of = found.face_first ? a : b;
        on_a = on_feature(vertex_of, std::array{found.a}, kWhole, found.time);
        on_b = on_feature(face_of, face_of.triangles[found.b], found.barycentric, found.time);
        if (found.face_first)
            std::swap(on_a, on_b);
    }
    Impact impact;
    impact.meet = true, impact.time = found.time;
    impact.point_a = on_a.point, impact.point_b = on_b.point;
    impact.triangle_a = on_a.triangle, impact.triangle_b = on_b.triangle;
    impact.gap = length(on_b.point - on_a.point);
    impact.normal = found.face_first ? found.normal : -found.normal;
    impact.status = found.status;
    if (found.status == Status::exact)
        impact.contact_time = std::min(1.0, found.time + kTimeError);
    return impact;
}

} // namespace

Impact surface_impact(const Deformable& a, const Deformable& b) {
    if (a.data().options.scheme == b.data().options.scheme &&
        a.data().options.culling == b.data().options.culling) {
        const auto found = time_of_impact(a, b);
        return found ? impact_of_features(a.data(), b.data(), *found) : Impact();
    }
    // The two schemes cannot be mixed. Rebuilds b's surface with the scheme of a.
    Mesh start;
    std::vector<Vec3> end;
    for (const MovingVertex& vertex : b.data().vertices)
        start.positions.push_back(vertex.start), end.push_back(vertex.end);
    start.triangles = b.triangles();
    Deformable alike(std::move(start), a.data().options);
    alike.advance(end);
    return surface_impact(a, alike);
}

} // namespace abut
