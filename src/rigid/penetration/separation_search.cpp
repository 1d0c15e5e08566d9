#include "rigid/penetration/separation_search.h"

#include "geometry/triangle_triangle_penetration.h"
#include "rigid/penetration/separating_motion.h"
#include "rigid/solid/containment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

constexpr double kAccuracy = 1.0 / 256;

class SeparationSearch {
public:
    SeparationSearch(const PlacedSolid& a, const PlacedSolid& b, double at_least,
                     Counters& counters, SearchSteps* steps)
        : a_(a), b_(b), nudge_(kNudge * std::max(a.world_size(), b.world_size())),
          at_least_(std::max(at_least, nudge_)), counters_(counters), steps_(steps) {}

    /// Returns whether the models are apart after the shift. False also if the steps are used up.
    [[nodiscard]] bool separates(const Vec3& shift) const { return separates(shift, steps_); }

    [[nodiscard]] bool separates(const Vec3& shift, SearchSteps* steps) const {
        const Transform moved = b_moved(shift);
        const PlacedPair pair(a_.model().model(), a_.model().world(), b_.model().model(), moved);
        if (!find_contacts(pair, ContactMode::first, counters_, steps).empty() ||
            (steps != nullptr && steps->ran_out()))
            return false;
        if (!a_.solid().solid && !b_.solid().solid)
            return true;
        const PlacedSolid b(b_.model().model(), b_.solid(), moved);
        return !any_component_inside(a_, b) && !any_component_inside(b, a_);
    }

    /// Separates the boxes of both trees along the axes of the world and of both trees: models
    /// whose boxes are apart are apart.
    void start_from_boxes() {
        std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (const PlacedSolid* s : {&a_, &b_}) {
            const auto& m = s->model().world_from_tree().m;
            for (std::size_t k = 0; k < 9; k += 3)
                axes.push_back(normalized_or_zero({m[k], m[k + 1], m[k + 2]}));
        }
        const std::vector<Vec3> corners_a = box_corners(a_), corners_b = box_corners(b_);
        std::vector<Vec3> ways;
        for (const Vec3& n : axes) {
            const auto [a_low, a_high] = extent(corners_a, n);
            const auto [b_low, b_high] = extent(corners_b, n);
            ways.push_back((a_high - b_low) * n);
            ways.push_back(-(b_high - a_low) * n);
        }
        std::sort(ways.begin(), ways.end(),
                  [](const Vec3& v, const Vec3& w) { return length_sq(v) < length_sq(w); });
        // The shortest shift may fail by rounding, which grows with the distance from the origin.
        for (double beyond = 0x1p-20; beyond < 0x1p20 && best_ == Vec3{}; beyond *= 16)
            for (const Vec3& way : ways) {
                const double size = a_.world_size() + b_.world_size();
                const Vec3 shift = way + (beyond * size) * normalized_or_zero(way);
                if (best_ == Vec3{} && separates(shift, nullptr))
                    best_ = shift;
            }
    }

    /// Bisects along one direction, if that may separate by a shorter translation than the best so
    /// far.
    void try_direction(const Vec3& direction) {
        double enough = (1 - kAccuracy) * length(best_);
        if (direction == Vec3{} || !(enough > at_least_) || !separates(enough * direction))
            return;
        best_ = enough * direction;
        shorten();
    }

    /// Takes a given translation if it is shorter and separates.
    bool try_shift(const Vec3& shift) {
        if (!(length(shift) < (1 - kAccuracy) * length(best_)) || !separates(shift))
            return false;
        best_ = shift;
        return true;
    }

    /// Bisects along the best translation.
    void shorten() {
        const Vec3 direction = normalized_or_zero(best_);
        double short_of = at_least_, enough = length(best_);
        while (enough - short_of > kAccuracy * enough) {
            const double middle = 0.5 * (short_of + enough);
            (separates(middle * direction) ? enough : short_of) = middle;
        }
        best_ = enough * direction;
        blocked_ = short_of * direction;
    }

    /// Slides along the triangles that block the motion just short of the best translation.
    void slide() {
        constexpr int kRounds = 16;
        for (int round = 0; round < kRounds && length(best_) > at_least_; ++round) {
            const Vec3 before = best_;
            for (const Vec3& n : blocking_normals()) {
                // The foot of the origin on the plane through `before` with normal n, and slightly
                // beyond.
                const double out = dot(before, n);
                if (out > 0 && try_shift((1 + 0.5 * kAccuracy) * out * n)) {
                    shorten();
                    break;
                }
            }
            if (best_ == before)
                return;
        }
    }

    /// Tries the smallest step along one direction.
    bool try_nudge(const Vec3& direction) {
        if (direction == Vec3{} || !separates(nudge_ * direction))
            return false;
        best_ = nudge_ * direction;
        return true;
    }

    [[nodiscard]] const Vec3& best() const { return best_; }

private:
    [[nodiscard]] Transform b_moved(const Vec3& shift) const {
        return translated(b_.model().world(), shift);
    }
    static std::vector<Vec3> box_corners(const PlacedSolid& s) {
        const Aabb& box = s.model().data().tree().bounds;
        std::vector<Vec3> corners;
        for (unsigned i = 0; i < 8; ++i)
            corners.push_back(
                apply(s.model().world_from_tree(),
                      {i & 1U ? box.upper[0] : box.lower[0], i & 2U ? box.upper[1] : box.lower[1],
                       i & 4U ? box.upper[2] : box.lower[2]}));
        return corners;
    }
    static std::array<double, 2> extent(const std::vector<Vec3>& points, const Vec3& n) {
        std::array<double, 2> e{std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
        for (const Vec3& p : points)
            e = {std::min(e[0], dot(n, p)), std::max(e[1], dot(n, p))};
        return e;
    }

    /// Directions that part some triangles in contact at `blocked_`, and their mean.
    [[nodiscard]] std::vector<Vec3> blocking_normals() const {
        constexpr std::size_t kContacts = 32, kNormals = 6;
        const Transform moved = b_moved(blocked_);
        const PlacedPair pair(a_.model().model(), a_.model().world(), b_.model().model(), moved);
        const std::vector<Contact> contacts =
            find_contacts(pair, ContactMode::all, counters_, steps_);
        const PlacedSolid b(b_.model().model(), b_.solid(), moved);
        std::vector<Vec3> normals;
        Vec3 mean;
        const std::size_t count = std::min(kContacts, contacts.size());
        for (std::size_t i = 0; i < count; ++i) {
            const TrianglePair& p = contacts[i * contacts.size() / count].pair;
            const Vec3 n =
                triangle_triangle_penetration(a_.world_triangle(p.a), b.world_triangle(p.b))
                    .direction;
            mean = mean + n;
            if (normals.size() < kNormals &&
                std::none_of(normals.begin(), normals.end(),
                             [&](const Vec3& m) { return dot(m, n) > 1 - 1e-6; }))
                normals.push_back(n);
        }
        normals.push_back(normalized_or_zero(mean));
        return normals;
    }

    const PlacedSolid& a_;
    const PlacedSolid& b_;
    double nudge_, at_least_; ///< shorter translations are not searched for
    Counters& counters_;
    SearchSteps* steps_;
    Vec3 best_, blocked_; ///< blocked_: shorter, along the same line; does not separate
};

} // namespace

Vec3 find_separation(const PlacedSolid& a, const PlacedSolid& b, std::span<const Vec3> directions,
                     double at_least, Counters& counters, SearchSteps* steps) {
    SeparationSearch search(a, b, at_least, counters, steps);
    for (const Vec3& d : directions)
        if (search.try_nudge(d))
            return search.best();
    search.start_from_boxes();
    if (search.best() == Vec3{})
        return {};
    search.shorten();
    search.slide();
    for (const Vec3& d : directions)
        search.try_direction(d);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                search.try_direction(normalized_or_zero({double(x), double(y), double(z)}));
    search.slide();
    return search.best();
}

Vec3 separation_of_boxes(const PlacedSolid& a, const PlacedSolid& b, Counters& counters) {
    SeparationSearch search(a, b, 0, counters, nullptr);
    search.start_from_boxes();
    return search.best();
}

} // namespace abut
