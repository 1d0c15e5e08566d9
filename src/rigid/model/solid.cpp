#include "rigid/model/solid.h"

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

int outward_by_winding(const Mesh& mesh) {
    OutwardVote vote;
    for (const std::uint32_t i : largest_triangles(mesh, kProbes)) {
        if (vote.failed())
            break;
        const FaceProbe probe = face_probe(triangle(mesh, i));
        const double over = winding_number(mesh, probe.over);
        if (OutwardVote::side(over) == 0)
            return 0;
        vote.add(over, winding_number(mesh, probe.under));
    }
    return vote.outward();
}

/// In: the mesh is closed.
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

bool is_near(double winding, double integer) {
    return std::abs(winding - integer) <= kWindingRounding;
}

} // namespace

double doubled_area_sq(const Triangle& t) {
    return length_sq(cross(t[1] - t[0], t[2] - t[0]));
}

FaceProbe face_probe(const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const Vec3 centre = (1.0 / 3) * (t[0] + t[1] + t[2]);
    // A thousandth of the triangle's size from its centroid.
    const Vec3 step = (1e-3 * std::sqrt(length(n))) * normalized_or_zero(n);
    return {centre + step, centre - step};
}

int OutwardVote::side(double over) {
    return is_near(over, 0) ? 1 : is_near(over, -1) ? -1 : 0;
}

void OutwardVote::add(double over, double under) {
    const int here = side(over);
    failed_ = failed_ || here == 0 || (outward_ != 0 && outward_ != here) ||
              !is_near(under, here > 0 ? 1 : 0);
    outward_ = here;
}

double half_solid_angle(const Triangle& t, const Vec3& point) {
    const Vec3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
    const double la = length(a), lb = length(b), lc = length(c);
    // tan(angle / 2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
    return std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

double winding_number(const Mesh& mesh, const Vec3& point) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        sum += half_solid_angle(triangle(mesh, i), point);
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
