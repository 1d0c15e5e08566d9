#include "rigid/model/face_fragments.h"

#include "core/disjoint_sets.h"
#include "core/stop.h"
#include "geometry/convex_polygon.h"
#include "geometry/ray_triangle_intersect.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace abut {

namespace {

/// Parts narrower than this share of the solids' size are not cut off, nor those narrower than so
/// many roundings: far above the rounding of the points where faces meet.
constexpr double kNarrowest = 0x1p-40, kNarrowestRoundings = 64;
/// Rounding of a point where faces meet, of its coordinates: some roundings of products.
constexpr double kPointRounding = 0x1p-50;
/// Fragments for each triangle, on average, and at least: more than any model of things has.
constexpr std::size_t kFragmentsPerTriangle = 64, kLeastBudget = 100'000;

/// Where a segment passes the plane of a triangle; the heights have different signs, or one is 0.
Vec3 at_plane(const Vec3& p, double height_p, const Vec3& q, double height_q) {
    const double drop = height_p - height_q;
    return drop == 0 ? p : p + std::clamp(height_p / drop, 0.0, 1.0) * (q - p);
}

} // namespace

/// A triangle that a ray meets.
struct FaceFragments::Hit {
    std::uint32_t triangle = 0;
    Triangle corners;
    RayTriangleHit where;
};

FaceFragments::FaceFragments(Mesh mesh, std::vector<Face> faces, double rounding)
    : placed_(Model(std::move(mesh)), {}), faces_(std::move(faces)),
      rounding_(rounding + kPointRounding * (2 * placed_.reach() + max_abs(placed_.middle()))),
      tolerance_(std::max(kNarrowest * 2 * placed_.reach(), kNarrowestRoundings * rounding_)),
      meets_(faces_.size()), same_(faces_.size()), thickness_(faces_.size()),
      budget_(std::max(kFragmentsPerTriangle * faces_.size(), kLeastBudget)) {
    find_meetings();
    find_layers();
    join_neighbours();
}

Box3 FaceFragments::box_of(std::uint32_t t) const {
    const Triangle c = corners(t);
    return {min(c[0], min(c[1], c[2])), max(c[0], max(c[1], c[2]))};
}

bool FaceFragments::are_same(std::uint32_t f, std::uint32_t g) const {
    return std::ranges::binary_search(same_[f], g);
}

/// Whether two triangles share more points than their common vertices and the edges between these.
bool FaceFragments::meets(std::uint32_t f, std::uint32_t g) const {
    const Triangle tf = corners(f), tg = corners(g);
    std::array<bool, 3> of_f{}, of_g{}; // common corners
    int common = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (tf[i] == tg[j])
                of_f.at(i) = of_g.at(j) = true, ++common;
    if (f == g || collinear(tg[0], tg[1], tg[2]))
        return false;
    if (common == 0)
        return triangle_triangle_intersect(tf, tg) != TriangleContact::none;
    const auto other = [](const std::array<bool, 3>& is_common, bool which) {
        return static_cast<std::size_t>(std::ranges::find(is_common, which) - is_common.begin());
    };
    if (common == 1) {
        // What they share begins at the common corner, and ends at the edge opposite to it of one.
        const std::size_t i = other(of_f, true), j = other(of_g, true);
        return segment_triangle_intersect(tf[(i + 1) % 3], tf[(i + 2) % 3], tg) ||
               segment_triangle_intersect(tg[(j + 1) % 3], tg[(j + 2) % 3], tf);
    }
    if (common == 3)
        return true;
    // Folded onto each other around the common edge.
    const Vec3 &p = tf[other(of_f, false)], &q = tg[other(of_g, false)];
    if (orient3d(tf[0], tf[1], tf[2], q) != 0)
        return false;
    const std::size_t i = other(of_f, false);
    const Vec3 &e0 = tf[(i + 1) % 3], &e1 = tf[(i + 2) % 3];
    const int axis = projection_axis(tf);
    return orient2d(e0, e1, p, axis) == orient2d(e0, e1, q, axis);
}

void FaceFragments::find_meetings() {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        poll_stop();
        const Triangle t = corners(f);
        if (collinear(t[0], t[1], t[2]))
            continue;
        placed_.for_each_overlap(grown(box_of(f), tolerance_), [&](std::uint32_t slot) {
            add_meeting(f, placed_.data().triangle_at(slot));
        });
        std::ranges::sort(meets_[f]);
    }
}

/// Adds what a triangle has in common with another one.
void FaceFragments::add_meeting(std::uint32_t f, std::uint32_t g) {
    const Triangle tf = corners(f), tg = corners(g);
    if (f == g || collinear(tg[0], tg[1], tg[2]))
        return;
    if (meets(f, g))
        meets_[f].push_back(g);
    if (f > g)
        return; // g has told whether they are the same
    const FacesOverlay whole = faces_overlay(tf, tg, 0);
    if (whole.area == 0)
        return;
    const FacesOverlay overlay = faces_overlay(tf, tg, tolerance_);
    if (overlay.area == 0)
        rim_ += whole.area;
    if (overlay.area == 0 || overlay.height > tolerance_)
        return;
    same_[f].push_back(g), same_[g].push_back(f);
    for (const std::uint32_t t : {f, g})
        thickness_[t] = std::max(thickness_[t], overlay.height);
}

/// Joins what lies on each other.
void FaceFragments::find_layers() {
    for (std::vector<std::uint32_t>& same : same_)
        std::ranges::sort(same);
    layer_ = same_;
    const std::vector<double> thickness = thickness_;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        const Box3 box = grown(box_of(f), 2 * tolerance_);
        for (const std::uint32_t g : same_[f]) {
            thickness_[f] = std::max(thickness_[f], thickness[f] + thickness[g]);
            std::ranges::copy_if(same_[g], std::back_inserter(layer_[f]), [&](std::uint32_t h) {
                return h != f && overlap(box, box_of(h));
            });
        }
        std::ranges::sort(layer_[f]);
        layer_[f].erase(std::unique(layer_[f].begin(), layer_[f].end()), layer_[f].end());
    }
}

/// Groups triangles that meet none, and are connected by edges of two of them.
void FaceFragments::join_neighbours() {
    DisjointSets sets(faces_.size());
    const Topology topology = make_topology(mesh());
    const std::vector<HalfEdge>& e = topology.half_edges;
    for (std::size_t begin = 0, end = 0; begin < e.size(); begin = end) {
        end = begin + topology.edge(e[begin].from, e[begin].to).size();
        if (end - begin == 2 && is_alone(e[begin].triangle) && is_alone(e[begin + 1].triangle) &&
            e[begin].from == e[begin + 1].to)
            sets.unite(e[begin].triangle, e[begin + 1].triangle);
    }
    group_ = std::move(sets).roots();
}

void FaceFragments::add_outline(const Triangle& g, std::vector<Cut>& cuts) const {
    for (std::size_t i = 0; i < 3; ++i)
        cuts.push_back({g[i], g[(i + 1) % 3]});
}

/// Adds the segments in which g meets the plane of f.
void FaceFragments::add_cuts(const Triangle& f, const Triangle& g, std::vector<Cut>& cuts) const {
    const Vec3 normal = normalized_or_zero(cross(f[1] - f[0], f[2] - f[0]));
    std::array<int, 3> side{};
    std::array<double, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) {
        side.at(i) = orient3d(f[0], f[1], f[2], g[i]);
        height.at(i) = side.at(i) == 0 ? 0 : dot(normal, g[i] - f[0]);
    }
    if (side == std::array<int, 3>{}) {
        add_outline(g, cuts);
        return;
    }
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        // Rounding decides where an edge in the plane of f passes it, and differs between the two
        // faces at the edge: their segments may leave a gap. So the whole edge cuts f.
        if (std::max(std::abs(height.at(i)), std::abs(height.at(j))) <= 2 * rounding_)
            cuts.push_back({g[i], g[j]});
        if (side.at(i) == 0)
            ends.push_back(g[i]);
        if (side.at(i) * side.at(j) < 0)
            ends.push_back(at_plane(g[i], height.at(i), g[j], height.at(j)));
    }
    if (ends.size() == 2)
        cuts.push_back({ends[0], ends[1]});
}

/// Splits a polygon by the line of a cut, if the cut passes through it. Returns whether it did.
bool FaceFragments::split(const Polygon& polygon, const Vec3& normal, const Cut& cut,
                          std::vector<Polygon>& parts) {
    const Vec3 along = cut.to - cut.from;
    const double reach = length(along);
    if (!(reach > tolerance_))
        return false;
    const Vec3 direction = (1 / reach) * along, across = cross(normal, direction);
    std::vector<double> height;
    for (const Vec3& p : polygon)
        height.push_back(dot(across, p - cut.from));
    const double over = std::max(0.0, *std::ranges::max_element(height)),
                 under = std::max(0.0, -*std::ranges::min_element(height));
    if (std::min(over, under) <= tolerance_) {
        uncertainty_.area += std::min(over, under) * reach;
        return false;
    }
    Polygon left, right;
    double first = HUGE_VAL, last = -HUGE_VAL;
    const auto add_to_both = [&](const Vec3& p) {
        left.push_back(p), right.push_back(p);
        first = std::min(first, dot(direction, p - cut.from));
        last = std::max(last, dot(direction, p - cut.from));
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = (i + 1) % polygon.size();
        if (std::abs(height[i]) <= tolerance_) {
            uncertainty_.area += std::abs(height[i]) * reach;
            add_to_both(polygon[i]);
        } else {
            (height[i] > 0 ? left : right).push_back(polygon[i]);
        }
        if (height[i] * height[j] < 0 && std::abs(height[i]) > tolerance_ &&
            std::abs(height[j]) > tolerance_)
            add_to_both(at_plane(polygon[i], height[i], polygon[j], height[j]));
    }
    if (std::min(last, reach) - std::max(first, 0.0) <= tolerance_ || left.size() < 3 ||
        right.size() < 3)
        return false;
    parts.push_back(std::move(left)), parts.push_back(std::move(right));
    return true;
}

std::vector<FaceFragments::Polygon> FaceFragments::cut(std::uint32_t f) {
    const Triangle t = corners(f);
    const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    std::vector<Cut> cuts;
    for (const std::uint32_t g : layer_[f])
        add_outline(corners(g), cuts);
    for (const std::uint32_t g : meets_[f])
        if (!are_same(f, g))
            add_cuts(t, corners(g), cuts);
    std::vector<Polygon> polygons{{t[0], t[1], t[2]}};
    for (const Cut& c : cuts) {
        std::vector<Polygon> next;
        for (Polygon& polygon : polygons)
            if (!split(polygon, normal, c, next))
                next.push_back(std::move(polygon));
        polygons = std::move(next);
        if (polygons.size() > budget_)
            break;
    }
    return polygons;
}

/// The triangles that a ray meets, in their order; none if it meets the border or the plane of one.
std::optional<std::vector<FaceFragments::Hit>> FaceFragments::hits_along(const Ray& ray,
                                                                         const Vec3& end) const {
    const double error = 0x1p-48 * (magnitude(ray.origin) + magnitude(end));
    const auto segment = placed_.tree_segment(ray.origin, end, error);
    std::vector<Hit> hits;
    if (!segment)
        return hits;
    bool clear = true;
    abut::for_each_on_segment(placed_.data().tree(), segment->segment, [&](std::uint32_t slot) {
        const std::uint32_t g = placed_.data().triangle_at(slot);
        const Triangle t = corners(g);
        std::array<int, 3> turn{};
        for (std::size_t k = 0; k < 3; ++k)
            turn.at(k) = turn_around_line(ray.origin, ray.direction, t[k], t[(k + 1) % 3]);
        const auto [least, most] = std::ranges::minmax(turn);
        if (least * most < 0)
            return;
        const auto hit = ray_triangle_intersect(ray, t);
        if (!hit)
            return;
        if (least * most == 0)
            clear = clear && collinear(t[0], t[1], t[2]);
        else
            hits.push_back({g, t, *hit});
    });
    if (!clear)
        return std::nullopt;
    std::ranges::sort(hits, [&](const Hit& a, const Hit& b) {
        const int order = compare_hits(ray, a.corners, a.where, b.corners, b.where);
        return order < 0 || (order == 0 && a.triangle < b.triangle);
    });
    return hits;
}

/// The first and the last hit of the layer that a hit is in: what lies between two faces that lie on
/// each other is in their layer.
std::pair<std::size_t, std::size_t> FaceFragments::layer_around(std::span<const Hit> hits,
                                                                std::size_t at) const {
    std::size_t first = at, last = at;
    const auto takes_in = [&](std::size_t i, std::size_t j) {
        const bool reaches = i <= last && j >= first && (i < first || j > last);
        return reaches && are_same(hits[i].triangle, hits[j].triangle);
    };
    for (bool grows = true; grows;) {
        grows = false;
        for (std::size_t i = 0; i < hits.size(); ++i)
            for (std::size_t j = i + 1; j < hits.size() && !same_[hits[i].triangle].empty(); ++j)
                if (takes_in(i, j))
                    first = std::min(first, i), last = std::max(last, j), grows = true;
    }
    return {first, last};
}

/// The sides of a triangle where a ray passes it; none if the ray misses it, or meets the border or
/// the plane of one.
std::optional<FaceFragments::Sides> FaceFragments::sides_along(std::uint32_t f, const Ray& ray,
                                                               const Vec3& end) const {
    const auto hit_f = ray_triangle_intersect(ray, corners(f));
    if (!hit_f || hit_f->side == 0)
        return std::nullopt;
    const auto hits = hits_along(ray, end);
    if (!hits)
        return std::nullopt;
    const auto at = std::ranges::find(*hits, f, &Hit::triangle);
    if (at == hits->end())
        return std::nullopt;
    auto [first, last] = layer_around(*hits, static_cast<std::size_t>(at - hits->begin()));
    Sides result;
    for (std::size_t i = first; i <= last; ++i) {
        const std::uint32_t g = (*hits)[i].triangle;
        result.is_first = result.is_first && g >= f;
        result.is_certain =
            result.is_certain && (g == f || std::ranges::binary_search(layer_[f], g));
    }
    // From where the stored normal of f points: the ray comes from there, or goes there.
    std::array<int, 2> ahead{}, from_here{};
    for (std::size_t i = first; i < hits->size(); ++i) {
        const Hit& hit = (*hits)[i];
        const Face& face = faces_[hit.triangle];
        // Winds once more before the hit than behind it, if the ray leaves through the face.
        const int times = -hit.where.side * face.weight;
        if (i > last)
            ahead.at(face.solid) += times;
        from_here.at(face.solid) += times;
    }
    result.over = hit_f->side > 0 ? from_here : ahead;
    result.under = hit_f->side > 0 ? ahead : from_here;
    return result;
}

/// The sides of a triangle at a point of it.
std::optional<FaceFragments::Sides> FaceFragments::sides(std::uint32_t f, const Vec3& point) const {
    const Triangle t = corners(f);
    const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    const double far = 4 * placed_.reach();
    for (int attempt = 0; attempt < 16; ++attempt) {
        // Close to the normal, so that the ray passes the triangle near the point; in no special
        // direction, so that it misses edges.
        const double angle = 2.399963229728653 * attempt + 0.7; // the golden angle
        const Vec3 u = normalized_or_zero(perpendicular(normal)), v = cross(normal, u);
        const Vec3 direction = normal + 0.317 * std::cos(angle) * u + 0.317 * std::sin(angle) * v;
        const Ray ray{point - far * direction, direction};
        if (const auto found = sides_along(f, ray, point + far * direction))
            return found;
    }
    return std::nullopt;
}

/// The area of f beside the line in which it meets g, on which rounding may tell the sides of the
/// wrong side of the line.
double FaceFragments::strip_beside(std::uint32_t f, std::uint32_t g) const {
    const Triangle tf = corners(f), tg = corners(g);
    const Vec3 n = normalized_or_zero(cross(tf[1] - tf[0], tf[2] - tf[0])),
               m = normalized_or_zero(cross(tg[1] - tg[0], tg[2] - tg[0]));
    const Box3 box_f = box_of(f), box_g = box_of(g);
    const double length_of_line =
        std::min(length(box_f.upper - box_f.lower), length(box_g.upper - box_g.lower));
    const double height = rounding_ + thickness_[f] + thickness_[g], sine = length(cross(n, m));
    constexpr double kLeastSine = 0x1p-52; // of planes that are parallel but for rounding
    const double strip = 2 * length_of_line * height / std::max(sine, kLeastSine);
    const bool is_steep = strip < length_of_line * tolerance_;
    return is_steep ? strip : std::min(strip, faces_overlay(tf, tg, tolerance_).area);
}

/// Adds what a face may tell wrongly.
void FaceFragments::add_uncertainty(std::uint32_t f, std::span<const Polygon> parts) {
    double around = 0;
    for (const Polygon& p : parts)
        for (std::size_t i = 0; i < p.size(); ++i)
            around += length(p[(i + 1) % p.size()] - p[i]);
    uncertainty_.area += 2 * rounding_ * around;
    for (const std::uint32_t g : meets_[f])
        if (!are_same(f, g))
            uncertainty_.area += strip_beside(f, g);
    const Triangle t = corners(f);
    uncertainty_.volume += thickness_[f] * area_of(t);
}

bool FaceFragments::for_each(const std::function<void(const Fragment&)>& visit) {
    uncertainty_ = {rim_, 0};
    std::vector<std::optional<Sides>> of_group(faces_.size());
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        poll_stop();
        const Triangle t = corners(f);
        if (collinear(t[0], t[1], t[2]))
            continue;
        std::vector<Polygon> polygons = cut(f);
        count += polygons.size();
        if (count > budget_)
            return false;
        add_uncertainty(f, polygons);
        const bool is_whole = polygons.size() == 1;
        for (Polygon& polygon : polygons) {
            std::optional<Sides>& known = of_group[group_[f]];
            const bool in_group = is_alone(f);
            std::optional<Sides> found = in_group && known ? known : sides(f, centroid_of(polygon));
            if (!found && is_whole)
                return false;
            if (!found || !found->is_certain)
                uncertainty_.area += area_of(polygon);
            if (!found)
                continue; // a fragment so narrow that rays pass beside it
            if (in_group)
                known = found;
            visit({f, std::move(polygon), is_whole, *found});
        }
    }
    return true;
}

} // namespace abut
