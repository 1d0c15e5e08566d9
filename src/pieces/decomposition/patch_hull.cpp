#include "pieces/decomposition/patch_hull.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// In hulls of more corners, planes through edges are not tried: some triangles then count as
/// entering the hull although they do not.
constexpr std::size_t kMostForEdges = 64;

/// The sides of a plane on which points lie.
struct Sides {
    bool front = false, back = false;

    void add(int side) { front = front || side > 0, back = back || side < 0; }
    [[nodiscard]] bool both() const { return front && back; }
};

Sides sides_of(const ExactPlane& plane, const Triangle& t) {
    Sides sides;
    for (const Vec3& p : t)
        sides.add(plane.side(p));
    return sides;
}

/// The half-space in front of a face's plane, if the triangle lies in it.
std::optional<PlacedModel::HalfSpace> in_front_of(const ExactPlane& plane, const Triangle& t) {
    for (const Vec3& p : t)
        if (plane.side(p) < 0)
            return std::nullopt;
    return PlacedModel::HalfSpace{plane.a, plane.normal};
}

/// The half-space beyond a plane, if the hull lies on one side and the triangle does not. A hull in
/// the plane itself has its inside on both sides. `add_hull(plane, sides)` adds the sides of the
/// hull.
template <typename AddHull>
std::optional<PlacedModel::HalfSpace> beyond(const ExactPlane& plane, const Triangle& t,
                                             const AddHull& add_hull) {
    const Sides of_t = sides_of(plane, t);
    if (of_t.both())
        return std::nullopt;
    Sides hull;
    add_hull(plane, hull);
    if (hull.back && !hull.front && !of_t.back)
        return PlacedModel::HalfSpace{plane.a, plane.normal};
    if (hull.front && !hull.back && !of_t.front)
        return PlacedModel::HalfSpace{plane.a, -1.0 * plane.normal};
    return std::nullopt;
}

} // namespace

void PatchHull::begin(const IndexTriangle& triangle, std::uint32_t number) {
    solid_.clear();
    front_ = planes_[number];
    polygon_.assign(triangle.begin(), triangle.end());
    axis_ = projection_axis(corners(triangle));
    turn_ = orient2d(front_.a, front_.b, front_.c, axis_);
    step_ = Step::none;
}

bool PatchHull::faces_alike(const Triangle& t) const {
    return orient2d(t[0], t[1], t[2], axis_) == turn_;
}

std::uint32_t PatchHull::common_corner(const IndexTriangle& t) const {
    for (const std::uint32_t v : t)
        if (solid_.is_corner(v))
            return v;
    return GrowingHull::kNone;
}

bool PatchHull::lies_behind(const IndexTriangle& triangle, std::uint32_t number,
                            bool has_area) const {
    if (!has_area)
        return true;
    const ExactPlane& plane = planes_[number];
    const auto in_front = [&](std::uint32_t v) { return plane.side(at(v)) > 0; };
    if (is_flat()) {
        // The first three corners of the polygon span its plane.
        const bool in_plane = std::all_of(polygon_.begin(), polygon_.begin() + 3,
                                          [&](auto v) { return plane.side(at(v)) == 0; });
        return in_plane ? faces_alike(corners(triangle))
                        : std::none_of(polygon_.begin(), polygon_.end(), in_front);
    }
    // If no neighbour of a corner in the plane is in front of it, no vertex is.
    const std::uint32_t corner = common_corner(triangle);
    const auto& faces = solid_.faces();
    if (corner != GrowingHull::kNone)
        return !solid_.any_around(corner, [&](std::uint32_t f, std::size_t k) {
            return in_front(faces[f].corners[(k + 1) % 3]);
        });
    return std::none_of(faces.begin(), faces.end(), [&](const GrowingHull::Face& f) {
        return f.alive && std::any_of(f.corners.begin(), f.corners.end(), in_front);
    });
}

void PatchHull::propose_in_plane(std::uint32_t vertex) {
    const std::size_t n = polygon_.size();
    const auto side = [&](std::size_t i) {
        return turn_ * orient2d(at(polygon_[i]), at(polygon_[(i + 1) % n]), at(vertex), axis_);
    };
    std::vector<int> sides(n);
    for (std::size_t i = 0; i < n; ++i)
        sides[i] = side(i);
    grows_ = std::any_of(sides.begin(), sides.end(), [](int s) { return s < 0; });
    if (!grows_)
        return;
    // The vertex replaces the edges that it sees, with those whose line holds it: they are
    // consecutive.
    const auto goes = [&](std::size_t i) { return sides[i % n] <= 0; };
    std::size_t first = 0;
    while (!goes(first) || goes(first + n - 1))
        ++first;
    std::size_t last = first;
    while (goes(last + 1))
        ++last;
    polygon_before_.swap(polygon_);
    polygon_.clear();
    polygon_.push_back(vertex);
    extend(gained_, at(vertex));
    for (std::size_t i = last + 1; i <= first + n; ++i)
        polygon_.push_back(polygon_before_[i % n]);
    for (std::size_t i = first; i <= last + 1; ++i)
        extend(gained_, at(polygon_before_[i % n]));
}

bool PatchHull::propose(std::uint32_t vertex, const IndexTriangle& triangle, bool has_area) {
    grows_ = false;
    gained_ = {};
    step_ = Step::none;
    if (is_flat()) {
        const int side = front_.side(at(vertex));
        if (side > 0)
            return false;
        if (side == 0) {
            propose_in_plane(vertex);
            step_ = grows_ ? Step::in_plane : Step::none;
            return true;
        }
        solid_.begin(polygon_, vertex);
        grows_ = true;
        step_ = Step::first_solid;
        extend(gained_, at(vertex));
        for (const std::uint32_t v : polygon_)
            extend(gained_, at(v));
        return true;
    }
    // A triangle without area has no plane that tells where to begin.
    solid_.look_from(vertex, has_area ? std::span(triangle) : std::span<const std::uint32_t>());
    const auto& faces = solid_.faces();
    for (const std::uint32_t f : solid_.visible())
        if (faces[f].is_closed)
            return false;
    grows_ = !solid_.visible().empty();
    if (!grows_)
        return true;
    step_ = Step::solid;
    extend(gained_, at(vertex));
    for (const std::uint32_t f : solid_.visible())
        for (const std::uint32_t v : faces[f].corners)
            extend(gained_, at(v));
    solid_.grow();
    return true;
}

void PatchHull::take_back() {
    if (step_ == Step::in_plane)
        polygon_.swap(polygon_before_);
    if (step_ == Step::first_solid)
        solid_.clear();
    if (step_ == Step::solid)
        solid_.take_back();
    step_ = Step::none;
}

void PatchHull::cover(const IndexTriangle& triangle, std::uint32_t number, bool has_area) {
    if (!is_flat() && has_area)
        solid_.close(planes_[number], common_corner(triangle));
}

std::optional<PatchHull::HalfSpace> PatchHull::outside_layer(const Triangle& t,
                                                             const ExactPlane& plane) const {
    const Sides front = sides_of(front_, t);
    if (!front.back && (front.front || collinear(t[0], t[1], t[2]) || faces_alike(t)))
        return HalfSpace{front_.a, front_.normal};
    const auto add_hull = [&](const ExactPlane& p, Sides& sides) {
        for (auto v = polygon_.begin(); v != polygon_.end() && !sides.both(); ++v)
            sides.add(p.side(at(*v)));
    };
    if (const auto found = beyond(plane, t, add_hull))
        return found;
    const std::size_t n = polygon_.size();
    if (n > kMostForEdges)
        return std::nullopt;
    for (const std::uint32_t v : polygon_)
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto found = beyond({t[k], t[(k + 1) % 3], at(v)}, t, add_hull))
                return found;
    for (std::size_t i = 0; i < n; ++i)
        for (const Vec3& r : t)
            if (const auto found =
                    beyond({at(polygon_[i]), at(polygon_[(i + 1) % n]), r}, t, add_hull))
                return found;
    return std::nullopt;
}

/// Hull and triangle with a common corner are apart if their cones at the corner are. A plane that
/// proves it passes through the corner.
std::optional<PatchHull::HalfSpace> PatchHull::outside_cone(std::uint32_t corner,
                                                            const IndexTriangle& triangle,
                                                            const ExactPlane& plane) const {
    const Triangle t = corners(triangle);
    const auto& faces = solid_.faces();
    std::vector<std::uint32_t> around;
    std::optional<HalfSpace> found;
    if (solid_.any_around(corner, [&](std::uint32_t f, std::size_t k) {
            around.push_back(faces[f].corners[(k + 1) % 3]);
            found = in_front_of(faces[f].plane, t);
            return found.has_value();
        }))
        return found;
    const auto add_hull = [&](const ExactPlane& p, Sides& sides) {
        for (auto v = around.begin(); v != around.end() && !sides.both(); ++v)
            sides.add(p.side(at(*v)));
    };
    if ((found = beyond(plane, t, add_hull)) || around.size() > kMostForEdges)
        return found;
    for (const std::uint32_t v : around)
        for (const Vec3& r : t)
            if ((found = beyond({at(corner), at(v), r}, t, add_hull)))
                return found;
    return std::nullopt;
}

std::optional<PatchHull::HalfSpace> PatchHull::outside_solid(const Triangle& t,
                                                             const ExactPlane& plane) {
    const auto& faces = solid_.faces();
    std::optional<HalfSpace> found;
    const auto is_in_front_of = [&](std::uint32_t f) {
        if (f < faces.size() && faces[f].alive && (found = in_front_of(faces[f].plane, t)))
            last_face_ = f;
        return found.has_value();
    };
    // The next triangle is probably near the last one, and near the newest faces.
    if (is_in_front_of(last_face_))
        return found;
    for (const std::uint32_t f : solid_.added())
        if (is_in_front_of(f))
            return found;
    if (is_in_front_of(solid_.climb(last_face_, t[0])))
        return found;
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        if (is_in_front_of(f))
            return found;
    const auto add_hull = [&](const ExactPlane& p, Sides& sides) {
        for (auto f = faces.begin(); f != faces.end() && !sides.both(); ++f)
            if (f->alive)
                for (const std::uint32_t v : f->corners)
                    sides.add(p.side(at(v)));
    };
    if ((found = beyond(plane, t, add_hull)) || solid_.corner_count() > kMostForEdges)
        return found;
    for (const GrowingHull::Face& f : faces)
        for (std::size_t k = 0; k < 3 && f.alive; ++k) {
            const Vec3 &p = at(f.corners[k]), &q = at(f.corners[(k + 1) % 3]);
            for (std::size_t j = 0; j < 3; ++j) {
                // Each edge of the hull once.
                if (f.corners[k] < f.corners[(k + 1) % 3])
                    if ((found = beyond({p, q, t[j]}, t, add_hull)))
                        return found;
                if ((found = beyond({t[j], t[(j + 1) % 3], p}, t, add_hull)))
                    return found;
            }
        }
    return std::nullopt;
}

std::optional<PatchHull::HalfSpace> PatchHull::outside(const IndexTriangle& triangle,
                                                       std::uint32_t number) {
    const ExactPlane& plane = planes_[number];
    if (is_flat())
        return outside_layer(corners(triangle), plane);
    const std::uint32_t corner = common_corner(triangle);
    return corner != GrowingHull::kNone ? outside_cone(corner, triangle, plane)
                                        : outside_solid(corners(triangle), plane);
}

} // namespace abut
