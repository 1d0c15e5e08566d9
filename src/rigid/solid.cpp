#include "rigid/solid.h"

#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace abut {

namespace {

Triangle triangle(const Mesh& mesh, std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

double doubled_area_sq(const Triangle& t) {
    return length_sq(cross(t[1] - t[0], t[2] - t[0]));
}

std::vector<std::uint32_t> largest_triangles(const Mesh& mesh, std::size_t count) {
    std::vector<std::pair<double, std::uint32_t>> by_area;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        by_area.emplace_back(-doubled_area_sq(triangle(mesh, i)), i);
    count = std::min(count, by_area.size());
    std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count),
                      by_area.end());
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(by_area[i].second);
    return result;
}

/// +1 or -1 if the mesh winds once around the points just under (over) its largest triangles and
/// not around those on the other side; else 0.
int outward_by_winding(const Mesh& mesh) {
    constexpr std::size_t kProbes = 6;
    int outward = 0;
    for (const std::uint32_t i : largest_triangles(mesh, kProbes)) {
        const Triangle t = triangle(mesh, i);
        const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
        const Vec3 centre = (1.0 / 3) * (t[0] + t[1] + t[2]);
        // A thousandth of the triangle's size off its middle.
        const Vec3 step = (1e-3 * std::sqrt(length(n))) * normalized_or_zero(n);
        const auto is = [](double w, double integer) {
            return std::abs(w - integer) <= kWindingRounding;
        };
        const double over = winding_number(mesh, centre + step);
        const int here = is(over, 0) ? 1 : is(over, -1) ? -1 : 0;
        if (here == 0 || (outward != 0 && outward != here) ||
            !is(winding_number(mesh, centre - step), here > 0 ? 1 : 0))
            return 0;
        outward = here;
    }
    return outward;
}

/// Of a closed mesh.
int outward_by_volume(const Mesh& mesh, const Topology& topology) {
    const auto& e = topology.half_edges;
    for (std::size_t i = 0; i < e.size(); i += 2)
        if (e[i].from == e[i + 1].from)
            return 0;
    double volume = 0;
    const Vec3 origin = mesh.positions[mesh.triangles[0][0]];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = triangle(mesh, i);
        volume += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin));
    }
    return (volume > 0) - (volume < 0);
}

} // namespace

double winding_number(const Mesh& mesh, const Vec3& point) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = triangle(mesh, i);
        const Vec3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
        const double la = length(a), lb = length(b), lc = length(c);
        // tan(angle / 2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
        sum += std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

Solid examine_solid(const Mesh& mesh) {
    Solid s;
    s.topology = make_topology(mesh);
    s.components = component_representatives(mesh, s.topology);
    s.closed = is_closed(s.topology);
    s.outward = s.closed ? outward_by_volume(mesh, s.topology) : outward_by_winding(mesh);
    s.solid = s.closed || s.outward != 0;
    return s;
}

} // namespace abut
