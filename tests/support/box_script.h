#pragma once

#include <abut/broad_phase.h>
#include <abut/types.h>

#include "tests/support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace abut::test {

using Pairs = std::vector<IndexPair>;

inline bool share_a_point(const Box3& a, const Box3& b) {
    const auto along = [](double la, double ua, double lb, double ub) {
        const double from = std::max(la, lb), to = std::min(ua, ub);
        return la <= ua && lb <= ub && from <= to && from < HUGE_VAL && to > -HUGE_VAL;
    };
    return along(a.lower.x, a.upper.x, b.lower.x, b.upper.x) &&
           along(a.lower.y, a.upper.y, b.lower.y, b.upper.y) &&
           along(a.lower.z, a.upper.z, b.lower.z, b.upper.z);
}

inline Pairs all_pairs(const std::vector<Box3>& boxes, const BroadPhaseOptions& options) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t k = i + 1; k < boxes.size(); ++k)
            if (share_a_point(boxes[i], boxes[k]) && (!options.filter || options.filter(i, k)))
                pairs.emplace_back(i, k);
    return pairs;
}

inline Pairs without(const Pairs& a, const Pairs& b) {
    Pairs rest;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
    return rest;
}

/// Properties of a script's boxes.
struct BoxSceneKind {
    const char* name;
    double lattice;  ///< coordinates are multiples of this; 0: arbitrary
    double offset;   ///< position of the world
    double overlaps; ///< approximate number of overlaps for each box
    bool clustered;
    double hubs = 0; ///< share of boxes that are about as large as the world
};

inline constexpr std::array kBoxSceneKinds{
    BoxSceneKind{"scattered", 0, 0, 4, false},
    BoxSceneKind{"clustered", 0, 0, 8, true},
    BoxSceneKind{"equal_coordinates", 0.125, 0, 6, false},
    BoxSceneKind{"far_away", 0, 1e7, 6, false},
    BoxSceneKind{"far_lattice", 0x1p-20, 0x1p23, 6, false},
    BoxSceneKind{"with_hubs", 0, 0, 4, false, 0.05},
    BoxSceneKind{"with_hubs_far_away", 0, 1e7, 4, false, 0.1},
    BoxSceneKind{"with_hubs_at_equal_coordinates", 0.125, 0, 4, false, 0.05}};

class BoxScript {
public:
    BoxScript(Random& random, const BoxSceneKind& kind, std::size_t count)
        : random_(random), kind_(kind), side_(std::cbrt(kind.overlaps / double(count)) / 2) {
        for (std::size_t i = 0; i < count; ++i)
            boxes_.push_back(anywhere());
    }

    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }

    /// Changes some boxes, or all, and returns their indices.
    std::vector<std::uint32_t> step() {
        switch (random_.integer(0, 6)) {
        case 0: // nothing changes
            return {};
        case 1: // all boxes drift
            return change(1, [&](const Box3& box) { return drifted(box, 0.02); });
        case 2: // all boxes jump
            return change(1, [&](const Box3&) { return anywhere(); });
        case 3: // a few boxes jump or leave
            return change(0.03,
                          [&](const Box3&) { return random_.chance(0.3) ? Box3() : anywhere(); });
        case 4: // a few boxes coincide with others or shrink to points
            return change(0.05, [&](const Box3& box) {
                const Box3& other = boxes_[std::size_t(random_.integer(0, int(boxes_.size()) - 1))];
                return random_.chance(0.5) ? other : Box3{box.lower, box.lower};
            });
        case 5: // one box spans the world; some boxes are new
            return grown();
        default: // many boxes move fast
            return change(0.4, [&](const Box3& box) { return drifted(box, 0.5); });
        }
    }

    /// Changes at most one in twenty boxes, or none, and returns their indices.
    std::vector<std::uint32_t> few() {
        const double share = random_.uniform(0, 0.04);
        return change(share, [&](const Box3& box) {
            switch (random_.integer(0, 9)) {
            case 0:
                return Box3();
            case 1: // spans the world
                return Box3{{-HUGE_VAL, -2e7, -2e7}, {HUGE_VAL, 2e7, 2e7}};
            case 2: // coincides with another one
                return boxes_[std::size_t(random_.integer(0, int(boxes_.size()) - 1))];
            case 3:
            case 4:
                return anywhere();
            default:
                return drifted(box.lower.x <= box.upper.x && box.lower.x > -1e9 ? box : anywhere(),
                               0.2);
            }
        });
    }

private:
    double snapped(double x) const {
        return kind_.lattice > 0 ? std::round(x / kind_.lattice) * kind_.lattice : x;
    }
    Vec3 snapped(const Vec3& p) const { return {snapped(p.x), snapped(p.y), snapped(p.z)}; }

    Box3 anywhere() {
        Vec3 middle = random_.in_cube(0.5);
        if (kind_.clustered) {
            const double corner = double(random_.integer(-2, 2)) * 0.2;
            middle = Vec3{corner, -corner, corner} + 0.15 * middle;
        }
        middle = middle + Vec3{kind_.offset, kind_.offset, -kind_.offset};
        const double scale = kind_.clustered ? 0.2 : 1;
        if (random_.chance(kind_.hubs)) {
            const Vec3 half{random_.uniform(0.1, 1), random_.uniform(0.1, 1), 0.5};
            return {snapped(middle - half), snapped(middle + half)};
        }
        const Vec3 half = (0.5 * side_ * scale) * (random_.in_cube(0.5) + Vec3{1, 1, 1});
        return {snapped(middle - half), snapped(middle + half)};
    }
    Box3 drifted(const Box3& box, double by) {
        const Vec3 way = (by * side_) * random_.in_cube();
        return {snapped(box.lower + way), snapped(box.upper + way)};
    }
    template <typename Changed>
    std::vector<std::uint32_t> change(double share, const Changed& changed) {
        std::vector<std::uint32_t> which;
        for (std::uint32_t i = 0; i < boxes_.size(); ++i)
            if (random_.chance(share)) {
                boxes_[i] = changed(boxes_[i]);
                which.push_back(i);
            }
        std::reverse(which.begin(), which.end());
        return which;
    }
    std::vector<std::uint32_t> grown() {
        std::vector<std::uint32_t> which{0};
        boxes_[0] = random_.chance(0.5) ? Box3{{-2e7, -2e7, -2e7}, {2e7, 2e7, 2e7}} : anywhere();
        if (random_.chance(0.2))
            boxes_[0] = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {0.1, HUGE_VAL, HUGE_VAL}};
        for (int count = random_.integer(0, 40); count > 0; --count) {
            which.push_back(std::uint32_t(boxes_.size()));
            boxes_.push_back(anywhere());
        }
        return which;
    }

    Random& random_;
    const BoxSceneKind& kind_;
    double side_;
    std::vector<Box3> boxes_;
};

} // namespace abut::test
