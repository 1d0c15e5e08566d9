#include "rigid/penetration/overlap_volume.h"

#include "core/stop.h"
#include "math/point_order.h"
#include "math/predicates.h"
#include "rigid/penetration/overlap_crossing.h"
#include "rigid/penetration/union_volume.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// A triangle of a surface near the other solid, with its normal outwards.
struct NearFace {
    std::uint32_t number = 0; ///< in the whole mesh
    Triangle corners;         ///< relative to the middle of the common box
    Box3 box;                 ///< of the corners
    std::array<std::uint32_t, 3> vertices{};
    std::array<double, 3> inside{}; ///< by edge: crossings of the other surface, as fractions
    std::array<int, 3> entered{};   ///< by edge: how often it enters the other solid, less leaves
    Vec3 doubled_area;              ///< of the segments in the face, seen from corner 0
    bool is_flat = false;           ///< without area: it takes no part
};

Box3 bounds_of(const Triangle& t) {
    return {min(t[0], min(t[1], t[2])), max(t[0], max(t[1], t[2]))};
}

Box3 widened(const Box3& box, double by) {
    const Vec3 margin{by, by, by};
    return {box.lower - margin, box.upper + margin};
}

bool contains_point(const Box3& box, const Vec3& p) {
    return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y &&
           box.lower.z <= p.z && p.z <= box.upper.z;
}

double doubled_area(const Triangle& t) {
    return length(cross(t[1] - t[0], t[2] - t[0]));
}

/// The triangles of one solid that reach a region.
class NearSurface {
public:
    /// In          shift: is added to all positions; origin: is subtracted before.
    NearSurface(const WorldSolid& solid, const Vec3& origin, const Vec3& shift)
        : solid_(solid), origin_(origin), shift_(shift) {}

    [[nodiscard]] std::vector<NearFace>& faces() { return faces_; }
    [[nodiscard]] const std::vector<NearFace>& faces() const { return faces_; }
    [[nodiscard]] const WorldSolid& solid() const { return solid_; }
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return (world - origin_) + shift_; }

    /// Calls visit(number, corners) for the triangles that may meet a local box. Returns false if
    /// visit did.
    template <typename Visit>
    bool for_each(const Box3& local, const Visit& visit) const {
        const double slack =
            8 * 0x1p-52 * (max_abs(origin_) + max_abs(local.lower) + max_abs(local.upper));
        const Vec3 back = origin_ - shift_;
        const Box3 world = widened({local.lower + back, local.upper + back}, slack);
        bool goes_on = true;
        solid_.for_each_block(world, [&](const WorldSolid::Block& block) {
            block.model.for_each_overlap(world, [&](std::uint32_t slot) {
                if (!goes_on)
                    return;
                const std::uint32_t triangle = block.model.data().triangle_at(slot);
                const std::uint32_t number = block.number(triangle);
                const int weight = solid_.weight(number);
                Triangle t = block.model.world_triangle(triangle);
                for (Vec3& p : t)
                    p = to_local(p);
                if (weight < 0)
                    std::swap(t[1], t[2]);
                if (weight != 0 && overlap(bounds_of(t), local))
                    goes_on = visit(number, t);
            });
            return goes_on;
        });
        return goes_on;
    }

    /// Reads the faces in a region; false if there are too many.
    bool read(const Box3& region) {
        const bool all = for_each(region, [&](std::uint32_t number, const Triangle& t) {
            NearFace face;
            face.number = number;
            face.corners = t;
            face.box = bounds_of(t);
            face.is_flat = collinear(t[0], t[1], t[2]);
            faces_.push_back(face);
            return faces_.size() <= kMostOverlapTriangles;
        });
        std::ranges::sort(faces_, {}, &NearFace::number);
        if (all)
            number_vertices();
        return all;
    }

    [[nodiscard]] NearFace* find(std::uint32_t number) {
        const auto at = std::ranges::lower_bound(faces_, number, {}, &NearFace::number);
        return at == faces_.end() || at->number != number ? nullptr : &*at;
    }
    [[nodiscard]] std::size_t vertices() const { return positions_.size(); }
    [[nodiscard]] const Vec3& position(std::uint32_t vertex) const { return positions_[vertex]; }
    /// The corners at a vertex: three times the index of the face, plus the corner's number.
    [[nodiscard]] std::span<const std::uint32_t> corners_at(std::uint32_t vertex) const {
        return std::span(corners_).subspan(first_corner_[vertex],
                                           first_corner_[vertex + 1] - first_corner_[vertex]);
    }

private:
    /// Gives corners at equal positions one number.
    void number_vertices() {
        const auto corner = [&](std::uint32_t c) -> const Vec3& {
            return faces_[c / 3].corners[c % 3];
        };
        corners_.reserve(3 * faces_.size());
        for (std::uint32_t c = 0; c < 3 * faces_.size(); ++c)
            corners_.push_back(c);
        std::sort(corners_.begin(), corners_.end(), [&](std::uint32_t c, std::uint32_t d) {
            return is_before(corner(c), corner(d));
        });
        for (std::uint32_t at = 0; at < corners_.size(); ++at) {
            const std::uint32_t c = corners_[at];
            if (positions_.empty() || positions_.back() != corner(c)) {
                positions_.push_back(corner(c));
                first_corner_.push_back(at);
            }
            faces_[c / 3].vertices[c % 3] = static_cast<std::uint32_t>(positions_.size() - 1);
        }
        first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }

    const WorldSolid& solid_;
    Vec3 origin_, shift_;
    std::vector<NearFace> faces_;
    std::vector<Vec3> positions_;        ///< of the vertices, sorted
    std::vector<std::uint32_t> corners_; ///< sorted by vertex
    std::vector<std::uint32_t>
        first_corner_; ///< by vertex: where its corners begin; then their end
};

/// How often a solid winds around a local point: none if that cannot be decided.
std::optional<int> winding_around(const NearSurface& surface, const Vec3& point) {
    const Box3 world = surface.solid().world_box();
    const Box3 box{surface.to_local(world.lower), surface.to_local(world.upper)};
    const Vec3 size = box.upper - box.lower;
    // The segments leave the box through its faces, a little askew, so that they miss edges.
    for (int attempt = 0; attempt < 6; ++attempt) {
        const double skew = 0x1p-7 * (attempt + 1);
        Vec3 end = point + Vec3{skew * size.x, 0.71 * skew * size.y, 0.43 * skew * size.z};
        const bool low = attempt % 2 == 1;
        if (attempt % 3 == 0)
            end.x = low ? box.lower.x - size.x : box.upper.x + size.x;
        else if (attempt % 3 == 1)
            end.y = low ? box.lower.y - size.y : box.upper.y + size.y;
        else
            end.z = low ? box.lower.z - size.z : box.upper.z + size.z;
        int winding = 0;
        const bool decided = surface.for_each(
            {min(point, end), max(point, end)}, [&](std::uint32_t, const Triangle& t) {
                const auto crossing = segment_crossing(point, end, t);
                winding -= crossing.value_or(0);
                return crossing.has_value();
            });
        if (decided)
            return winding;
    }
    return std::nullopt;
}

/// The plane of a face, as a filter before exact tests.
class PlaneOf {
public:
    explicit PlaneOf(const Triangle& t) : base_(t[0]) {
        const Vec3 u = t[1] - t[0], v = t[2] - t[0];
        normal_ = cross(u, v);
        // Bounds the errors of a product below for points at a unit of distance.
        rounding_ = 0x1p-48 * sum_of_sizes(u) * sum_of_sizes(v);
    }
    /// Returns whether all corners certainly lie strictly on one side.
    [[nodiscard]] bool has_on_one_side(const Triangle& t) const {
        int over = 0, under = 0;
        for (const Vec3& p : t) {
            const Vec3 from = p - base_;
            const double height = dot(normal_, from);
            const double error = rounding_ * sum_of_sizes(from);
            over += height > error ? 1 : 0;
            under += height < -error ? 1 : 0;
        }
        return over == 3 || under == 3;
    }

private:
    Vec3 base_, normal_;
    double rounding_ = 0;
};

/// The common solid of two surfaces, of which b is moved by a tiny vector.
class CommonSolid {
public:
    CommonSolid(const WorldSolid& a, const WorldSolid& b, const Vec3& origin, const Vec3& shift)
        : a_(a, origin, {}), b_(b, origin, shift) {}

    enum class Outcome : std::uint8_t { done, degenerate, too_large };
    Outcome integrate(const Box3& region) {
        if (!a_.read(region) || !b_.read(region))
            return Outcome::too_large;
        if (!cross_all() || !wind(a_, b_) || !wind(b_, a_))
            return Outcome::degenerate;
        return Outcome::done;
    }
    [[nodiscard]] double volume() const { return volume_ / 6; }
    [[nodiscard]] const NearSurface& a() const { return a_; }
    [[nodiscard]] const NearSurface& b() const { return b_; }

private:
    /// Up to this many faces are all tested; of more, the hierarchy finds those near by.
    static constexpr std::size_t kFew = 4096;

    /// Finds all pairs of faces that cross; false if one is degenerate.
    bool cross_all() {
        const bool a_leads = a_.faces().size() <= b_.faces().size();
        NearSurface &leading = a_leads ? a_ : b_, &other = a_leads ? b_ : a_;
        const bool few = other.faces().size() <= kFew;
        for (NearFace& face : leading.faces()) {
            poll_stop();
            if (face.is_flat)
                continue;
            const PlaneOf plane(face.corners);
            const auto test = [&](NearFace& found) {
                return found.is_flat || !overlap(face.box, found.box) ||
                       plane.has_on_one_side(found.corners) ||
                       cross(a_leads ? face : found, a_leads ? found : face);
            };
            if (few ? !std::ranges::all_of(other.faces(), test) : !cross_near(other, face, test))
                return false;
        }
        return true;
    }

    /// Calls test(found) for the faces near a face, until it returns false.
    template <typename Test>
    static bool cross_near(NearSurface& other, const NearFace& face, const Test& test) {
        std::vector<std::uint32_t> met;
        other.for_each(face.box, [&](std::uint32_t number, const Triangle&) {
            met.push_back(number);
            return true;
        });
        std::ranges::sort(met); // so that sums do not depend on the order of the hierarchy
        return std::ranges::all_of(met, [&](std::uint32_t number) {
            NearFace* const found = other.find(number);
            return found == nullptr || test(*found);
        });
    }

    static bool cross(NearFace& f, NearFace& g) {
        const FaceCrossing crossing = cross_faces(f.corners, g.corners);
        if (crossing.is_degenerate)
            return false;
        if (!crossing.is_there)
            return true;
        for (const FaceCrossing::End& end : {crossing.start, crossing.stop}) {
            NearFace& face = end.of_a ? f : g;
            face.inside.at(end.edge) += end.enters ? -end.fraction : end.fraction;
            face.entered.at(end.edge) += end.enters ? 1 : -1;
        }
        const auto add = [](NearFace& face, const Vec3& from, const Vec3& to) {
            const Vec3& base = face.corners[0];
            face.doubled_area = face.doubled_area + abut::cross(from - base, to - base);
        };
        add(f, crossing.start.point, crossing.stop.point);
        add(g, crossing.stop.point, crossing.start.point);
        return true;
    }

    /// Finds how often `other` winds around each vertex, and adds the integral over the faces.
    /// Returns false if the surfaces contradict each other.
    bool wind(const NearSurface& surface, const NearSurface& other) {
        constexpr int kUnknown = INT_MAX;
        std::vector<int> winding(surface.vertices(), kUnknown);
        const Box3 world = other.solid().world_box();
        const Box3 box = widened({other.to_local(world.lower), other.to_local(world.upper)},
                                 0x1p-40 * (max_abs(world.lower) + max_abs(world.upper)));
        std::vector<std::uint32_t> known_vertices;
        for (std::uint32_t v = 0; v < winding.size(); ++v)
            if (!contains_point(box, surface.position(v))) {
                winding[v] = 0;
                known_vertices.push_back(v);
            }
        if (!spread(surface, std::move(known_vertices), winding))
            return false;
        for (const NearFace& face : surface.faces()) {
            poll_stop();
            if (face.is_flat || winding[face.vertices[0]] != kUnknown)
                continue;
            const auto known = winding_around(other, face.corners[0]);
            if (!known)
                return false;
            winding[face.vertices[0]] = *known;
            if (!spread(surface, {face.vertices[0]}, winding))
                return false;
        }
        for (const NearFace& face : surface.faces())
            if (!face.is_flat)
                add_face(face, winding[face.vertices[2]]);
        return true;
    }

    /// Adds the part of a face that lies inside the other solid. Its edges at corner 0 add nothing.
    void add_face(const NearFace& face, int winding_at_2) {
        const Vec3& base = face.corners[0];
        const Vec3 whole = abut::cross(face.corners[1] - base, face.corners[2] - base);
        volume_ += dot(base, (winding_at_2 + face.inside[1]) * whole + face.doubled_area);
    }

    /// Carries winding numbers from the vertices `reached` along the edges of faces to all vertices
    /// that these connect. Returns false if two ways to a vertex disagree.
    static bool spread(const NearSurface& surface, std::vector<std::uint32_t> reached,
                       std::vector<int>& winding) {
        while (!reached.empty()) {
            const std::uint32_t vertex = reached.back();
            reached.pop_back();
            for (const std::uint32_t corner : surface.corners_at(vertex)) {
                const NearFace& face = surface.faces()[corner / 3];
                if (face.is_flat)
                    continue;
                const std::size_t leaves = corner % 3, arrives = (leaves + 2) % 3;
                const std::uint32_t next = face.vertices.at((leaves + 1) % 3);
                const std::uint32_t last = face.vertices.at(arrives);
                for (const auto& [other, value] :
                     {std::pair(next, winding[vertex] + face.entered.at(leaves)),
                      std::pair(last, winding[vertex] - face.entered.at(arrives))}) {
                    if (winding[other] == INT_MAX) {
                        winding[other] = value;
                        reached.push_back(other);
                    } else if (winding[other] != value) {
                        return false;
                    }
                }
            }
        }
        return true;
    }

    NearSurface a_, b_;
    double volume_ = 0; ///< six times
};

/// Returns how much a tiny motion of a surface in a box of this diagonal, the rounding of its
/// positions and crossings, and its T-junctions can change a volume.
double volume_error(const NearSurface& surface, double diagonal, double shift) {
    constexpr double kRounding = 0x1p-46, kJunctions = 0x1p-20;
    const double positions = position_rounding(surface.solid().world_box());
    double in_box = 0, rounding = 0;
    for (const NearFace& face : surface.faces()) {
        const double area = doubled_area(face.corners);
        in_box += std::min(area / 2, diagonal * diagonal);
        rounding += kRounding * std::max(area, diagonal * diagonal);
    }
    const double gaps = surface.solid().closed() ? 0 : kJunctions * diagonal;
    return in_box * (shift + positions + gaps) + rounding * diagonal;
}

} // namespace

std::optional<OverlapVolume> overlap_volume(const WorldSolid& a, const WorldSolid& b) {
    if (!a.is_oriented() || !b.is_oriented() || !a.knows_boundary() || !b.knows_boundary())
        return std::nullopt;
    if (a.boundary() != nullptr || b.boundary() != nullptr)
        return union_overlap_volume(a, b);
    const Box3 box_a = a.world_box(), box_b = b.world_box();
    const Box3 common{max(box_a.lower, box_b.lower), min(box_a.upper, box_b.upper)};
    if (is_empty(common))
        return OverlapVolume{};
    const double diagonal = length(common.upper - common.lower);
    const Vec3 origin = 0.5 * common.lower + 0.5 * common.upper;
    const double reach =
        std::max({length(box_a.upper - box_a.lower), length(box_b.upper - box_b.lower), diagonal});
    double shift = std::max(0x1p-38 * diagonal, 0x1p-49 * reach);
    constexpr std::array kDirections{Vec3{0.53, 0.61, 0.59}, Vec3{-0.67, 0.41, 0.62},
                                     Vec3{0.37, -0.71, 0.60}};
    for (const Vec3& direction : kDirections) {
        CommonSolid solid(a, b, origin, shift * direction);
        const Box3 local = widened({common.lower - origin, common.upper - origin}, 2 * shift);
        const auto outcome = solid.integrate(local);
        if (outcome == CommonSolid::Outcome::too_large)
            break;
        if (outcome == CommonSolid::Outcome::done)
            return finite_volume(solid.volume(), volume_error(solid.a(), diagonal, shift) +
                                                     volume_error(solid.b(), diagonal, shift));
        shift *= 64;
    }
    return std::nullopt;
}

std::optional<OverlapVolume> solid_volume(const WorldSolid& solid) {
    if (!solid.is_oriented() || !solid.knows_boundary())
        return std::nullopt;
    if (solid.boundary() != nullptr)
        return union_volume(solid);
    const Box3 box = solid.world_box();
    const double diagonal = length(box.upper - box.lower);
    NearSurface surface(solid, 0.5 * box.lower + 0.5 * box.upper, {});
    const Vec3 half = 0.5 * (box.upper - box.lower);
    if (!surface.read(widened({-half, half}, 0x1p-20 * diagonal)))
        return std::nullopt;
    double volume = 0;
    for (const NearFace& face : surface.faces())
        volume += dot(face.corners[0], cross(face.corners[1], face.corners[2])) / 6;
    return finite_volume(volume, volume_error(surface, diagonal, 0));
}

} // namespace abut
