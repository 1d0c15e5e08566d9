#include "rigid/penetration/contact_regions.h"

#include "core/disjoint_sets.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_segment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {

namespace {

/// An edge of a triangle in contact, or a vertex of one (v = w).
struct ContactFeature {
    std::uint32_t v, w; ///< merged vertices, v <= w
    std::uint32_t contact;
    [[nodiscard]] bool same(const ContactFeature& f) const { return v == f.v && w == f.w; }
    /// Edges first: they decide nearly all connections.
    bool operator<(const ContactFeature& f) const {
        const bool point = v == w, f_point = f.v == f.w;
        return point != f_point ? f_point : std::tie(v, w, contact) < std::tie(f.v, f.w, f.contact);
    }
};

/// Connects the contacts of one triangle across the edges and vertices of `other` that meet it.
void connect_around(const Triangle& triangle, const PlacedSolid& other,
                    const std::vector<Contact>& contacts, std::span<const std::uint32_t> group,
                    std::uint32_t TrianglePair::*side, DisjointSets& sets) {
    std::vector<ContactFeature> features;
    const auto& vertex_of = other.solid().topology.vertex_of;
    for (const std::uint32_t c : group) {
        const auto& t = other.model().data().mesh().triangles[contacts[c].pair.*side];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [v, w] = std::minmax({vertex_of[t[k]], vertex_of[t[(k + 1) % 3]]});
            features.push_back({v, w, c});
            features.push_back({vertex_of[t[k]], vertex_of[t[k]], c});
        }
    }
    std::sort(features.begin(), features.end());
    for (std::size_t i = 1; i < features.size(); ++i) {
        const ContactFeature &f = features[i - 1], &g = features[i];
        if (!f.same(g) || sets.root(f.contact) == sets.root(g.contact))
            continue;
        const Vec3 p = other.model().world_vertex(f.v), q = other.model().world_vertex(f.w);
        if (triangle_triangle_intersect(triangle, {p, q, q}) != TriangleContact::none)
            sets.unite(f.contact, g.contact);
    }
}

/// Connects contacts that share a triangle of `model`. In: `order` lists the contacts by that
/// triangle.
void connect(const PlacedSolid& model, std::uint32_t TrianglePair::*of_model,
             const PlacedSolid& other, std::uint32_t TrianglePair::*of_other,
             const std::vector<Contact>& contacts, std::span<const std::uint32_t> order,
             DisjointSets& sets) {
    const auto triangle = [&](std::uint32_t c) { return contacts[c].pair.*of_model; };
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        poll_stop();
        while (end < order.size() && triangle(order[end]) == triangle(order[begin]))
            ++end;
        if (end - begin > 1)
            connect_around(model.world_triangle(triangle(order[begin])), other, contacts,
                           order.subspan(begin, end - begin), of_other, sets);
    }
}

int facing(const PlacedSolid& model) {
    return model.outward() < 0 ? -1 : 1;
}

Box3 box_of(const Triangle& t) {
    Box3 box;
    for (const Vec3& p : t)
        extend(box, p);
    return box;
}

double distance_sq(const Box3& box, const Vec3& p) {
    const Vec3 d = max(max(box.lower - p, p - box.upper), {0, 0, 0});
    return length_sq(d);
}

} // namespace

std::vector<RegionContacts> find_regions(const PlacedSolid& a, const PlacedSolid& b,
                                         const std::vector<Contact>& contacts) {
    DisjointSets sets(contacts.size());
    std::vector<std::uint32_t> order(contacts.size());
    std::iota(order.begin(), order.end(), 0U);
    connect(a, &TrianglePair::a, b, &TrianglePair::b, contacts, order, sets);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        const TrianglePair &p = contacts[i].pair, &q = contacts[j].pair;
        return std::tie(p.b, p.a) < std::tie(q.b, q.a);
    });
    connect(b, &TrianglePair::b, a, &TrianglePair::a, contacts, order, sets);

    std::vector<RegionContacts> regions;
    std::vector<std::uint32_t> region_of(contacts.size());
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
        poll_stop();
        const std::uint32_t root = sets.root(i);
        if (root == i) {
            region_of[i] = static_cast<std::uint32_t>(regions.size());
            regions.emplace_back();
        }
        RegionContacts& region = regions[region_of[root]];
        const TrianglePair& pair = contacts[i].pair;
        region.contacts.push_back(contacts[i]);
        region.common.push_back(
            triangle_triangle_segment(a.world_triangle(pair.a), b.world_triangle(pair.b)));
    }
    return regions;
}

Vec3 enclosed_area(const PlacedSolid& a, const PlacedSolid& b, const RegionContacts& region) {
    // A direction in general position to the axes and to other such directions.
    constexpr Vec3 kDirection{0.30115, 0.54772, 0.78056};
    const bool general =
        std::all_of(region.contacts.begin(), region.contacts.end(),
                    [](const Contact& c) { return c.kind == TriangleContact::cross; });
    const Vec3 step = 0x1p-30 * std::max(a.world_size(), b.world_size()) * kDirection;
    std::vector<std::array<Vec3, 2>> segments;
    for (std::size_t i = 0; i < region.contacts.size(); ++i) {
        Intersection common = region.common[i];
        if (!general) {
            const TrianglePair& pair = region.contacts[i].pair;
            Triangle tb = b.world_triangle(pair.b);
            for (Vec3& p : tb)
                p = p + step;
            common = triangle_triangle_segment(a.world_triangle(pair.a), tb);
        }
        if (common.count == 2)
            segments.push_back({common.corners[0], common.corners[1]});
    }
    if (segments.empty())
        return {};
    const Vec3 origin = segments[0][0]; // near the curve, so that differences are small and exact
    Vec3 moment;
    double total = 0;
    for (const auto& [p, q] : segments) {
        const double l = length(q - p);
        moment = moment + 0.5 * l * ((p - origin) + (q - origin));
        total += l;
    }
    const Vec3 centroid = total > 0 ? origin + (1 / total) * moment : origin;
    Vec3 area;
    for (const auto& [p, q] : segments)
        area = area + 0.5 * cross(p - centroid, q - centroid);
    return double(facing(a) * facing(b)) * area;
}

TouchingArea touching_area(const PlacedSolid& a, const RegionContacts& region) {
    TouchingArea result;
    for (const Intersection& polygon : region.common) {
        Vec3 area;
        for (std::uint32_t k = 2; k < polygon.count; ++k)
            area = area + 0.5 * cross(polygon.corners[k - 1] - polygon.corners[0],
                                      polygon.corners[k] - polygon.corners[0]);
        result.area += length(area);
        result.weighted_normal = result.weighted_normal + double(facing(a)) * area;
    }
    return result;
}

RegionCells::RegionCells(const std::vector<RegionContacts>& regions) {
    constexpr std::uint32_t kChunk = 16;
    for (std::uint32_t r = 0; r < regions.size(); ++r)
        for (std::size_t i = 0; i < regions[r].common.size(); ++i) {
            const Intersection& common = regions[r].common[i];
            if (i % kChunk == 0)
                chunks_.push_back({{}, r, static_cast<std::uint32_t>(pieces_.size()), 0});
            const auto& c = common.corners;
            for (std::uint32_t k = std::min(common.count, 3U) - 1; k < common.count; ++k) {
                pieces_.push_back({c[0], c[std::max(k, 1U) - 1], c[k]});
                const Box3 box = box_of(pieces_.back());
                extend(chunks_.back().box, box.lower), extend(chunks_.back().box, box.upper);
                ++chunks_.back().count;
            }
        }
}

double RegionCells::nearest_sq(const Chunk& chunk, const Vec3& point, double bound_sq) const {
    if (distance_sq(chunk.box, point) >= bound_sq)
        return bound_sq;
    for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i)
        bound_sq = std::min(bound_sq, point_triangle_distance(point, pieces_[i]).distance_sq);
    return bound_sq;
}

bool RegionCells::may_hold(std::uint32_t region, const Vec3& point, double radius) const {
    double own_sq = std::numeric_limits<double>::infinity();
    for (const Chunk& chunk : chunks_)
        if (chunk.region == region)
            own_sq = nearest_sq(chunk, point, own_sq);
    // A point belongs to the region unless another region is nearer; distances change by `radius`
    // at most. A point at equal distances, to rounding, belongs to both, so rounding does not
    // decide.
    const double own = std::sqrt(own_sq),
                 enough = own - 2 * radius - 0x1p-40 * (own + max_abs(point));
    if (!(enough > 0))
        return true;
    const double enough_sq = enough * enough;
    return std::all_of(chunks_.begin(), chunks_.end(), [&](const Chunk& chunk) {
        return chunk.region == region || nearest_sq(chunk, point, enough_sq) >= enough_sq;
    });
}

} // namespace abut
