#include "rigid/model/solid.h"

#include "math/vector.h"
#include "rigid/model/clean_surface.h"
#include "rigid/model/open_solids.h"
#include "rigid/model/shells.h"
#include "rigid/model/winding_vote.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace abut {

namespace {

Triangle triangle(const Mesh& mesh, std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// Takes over how the shells of a closed surface bound the solid.
ShellOrientation orient(Solid& s, const Mesh& mesh, const std::vector<bool>& dropped) {
    ShellOrientation shells = orient_shells(mesh, s.topology, dropped);
    s.outward = shells.outward;
    s.weights = std::move(shells.weights);
    s.has_parity_only = shells.has_parity_only;
    s.may_overlap = shells.may_overlap;
    return shells;
}

/// Gives the triangles of open components that bound a solid but for T-junctions their weight.
void add_open(Solid& s, const Mesh& mesh, const std::vector<OpenSolid>& solids) {
    if (solids.empty())
        return;
    const bool any_closed = s.closed;
    s.solid = true;
    s.closed = false;
    if (s.weights.empty())
        s.weights.assign(mesh.triangles.size(),
                         static_cast<std::int8_t>(any_closed ? s.outward : 0));
    for (const OpenSolid& open : solids)
        for (std::size_t i = 0; i < open.triangles.size(); ++i)
            s.weights[open.triangles[i]] = open.weights[i];
    const bool any_out = std::ranges::find(s.weights, 1) != s.weights.end(),
               any_in = std::ranges::find(s.weights, -1) != s.weights.end();
    s.outward = any_out && any_in ? 0 : any_out ? 1 : -1;
    s.may_overlap = s.may_overlap || may_overlap(mesh, s, solids);
    if (std::ranges::find(s.weights, 0) == s.weights.end() && s.outward != 0)
        s.weights.clear();
}

/// Takes a whole mesh as one solid with T-junctions, if it is one. Then a part of it that is closed may
/// have a face of its neighbour: where two solids share edges, either may have been peeled.
void take_whole(const Mesh& mesh, const Topology& topology, CleanSurface& clean, OpenSolids& open) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (!std::ranges::binary_search(clean.copies, t))
            all.push_back(t);
    std::optional<SetWinding> found = winding_of(mesh, topology, all);
    if (!found)
        return;
    clean.closed = false;
    open = {};
    open.solids.push_back({std::move(all), std::move(found->weights), found->may_overlap});
}

/// Examines a mesh with an edge that is not used by exactly two triangles.
void examine_faulty(Solid& s, const Mesh& mesh) {
    CleanSurface clean = clean_surface(mesh, s.topology);
    OpenSolids open = find_open_solids(mesh, s.topology, clean);
    if (clean.closed && open.has_sheets)
        take_whole(mesh, s.topology, clean, open);
    s.closed = s.solid = clean.closed;
    s.copies = clean.copies;
    if (s.closed && orient(s, mesh, clean.dropped).are_flat && !open.solids.empty())
        s.closed = s.has_parity_only = s.may_overlap = false, s.weights.clear();
    add_open(s, mesh, open.solids);
    std::erase_if(s.copies, [&](std::uint32_t t) { return s.weight(t) != 0; });
    if (s.solid)
        s.open = std::move(open.rest);
    s.has_sheets = s.solid ? !s.open.empty() || open.has_sheets : clean.has_sheets;
}

/// Spreads the bits of a number. Source: splitmix64 [Steele, Lea, Flood 2014].
std::uint64_t mixed_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ x >> 30U) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27U) * 0x94d049bb133111eb;
    return x ^ x >> 31U;
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
    const double times = std::round(over);
    return !is_near(over, times) ? 0 : times >= 0 ? 1 : -1;
}

void OutwardVote::add(double over, double under) {
    const int here = side(over);
    const double times = std::round(under) - std::round(over);
    if (here != 0 && times == 0 && is_near(under, std::round(under)))
        return;
    failed_ = failed_ || here == 0 || (outward_ != 0 && outward_ != here) || times < 0 ||
              !is_near(under, std::round(under));
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

double winding_number(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                      const Vec3& point) {
    double sum = 0;
    for (const std::uint32_t i : triangles)
        sum += half_solid_angle(triangle(mesh, i), point);
    return sum / (2 * std::numbers::pi);
}

double winding_number(const Mesh& mesh, const Solid& solid, const Vec3& point) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        if (const int weight = solid.weight(i); weight != 0)
            sum += weight * half_solid_angle(triangle(mesh, i), point);
    return sum / (2 * std::numbers::pi);
}

bool bounds_solid(const Mesh& mesh) {
    std::uint64_t sum = 0;
    bool any = false;
    for (const auto& t : mesh.triangles) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            continue;
        any = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t from = t[k], to = t[(k + 1) % 3];
            const std::uint64_t hash = mixed_bits(std::min(from, to) << 32U | std::max(from, to));
            sum += from < to ? hash : -hash;
        }
    }
    return (any && sum == 0) || examine_solid(mesh).solid;
}

Solid examine_solid(const Mesh& mesh) {
    Solid s;
    s.topology = make_topology(mesh);
    s.closed = s.solid = is_closed(s.topology);
    std::uint32_t shells = 0;
    if (s.closed)
        shells = orient(s, mesh, {}).count;
    else
        examine_faulty(s, mesh);
    // A triangle with two equal vertices has no edges; it may be a component by itself.
    const bool all_have_edges = s.topology.half_edges.size() == 3 * mesh.triangles.size();
    if (shells == 1 && all_have_edges)
        s.components = {0};
    else
        s.components = component_representatives(mesh, s.topology);
    return s;
}

} // namespace abut
