#pragma once

#include "clash/groups/group_facts.h"
#include "clash/groups/point_grid.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

/// The centres of earlier places, numbered in the order in which they are added.
class EarlierPlaces {
public:
    /// In          reach: as GroupOptions::reach.
    explicit EarlierPlaces(double reach) : reach_(reach), grid_(reach) {}

    void add(const Vec3& centre) {
        grid_.add(static_cast<std::uint32_t>(centres_.size()), centre);
        centres_.push_back(centre);
    }

    /// Returns the place within reach that is nearest to a point; of equals, the first one.
    [[nodiscard]] std::optional<std::uint32_t> nearest(const Vec3& point) const {
        std::optional<std::uint32_t> best;
        double nearest = reach_ * reach_;
        grid_.for_each_cell(point, [&](const std::vector<std::uint32_t>& cell) {
            for (const std::uint32_t i : cell) {
                const double distance = symmetric_distance_sq(centres_[i], point);
                if (distance < nearest || (distance == nearest && (!best || i < *best))) {
                    nearest = distance;
                    best = i;
                }
            }
        });
        return best;
    }

private:
    double reach_;
    std::vector<Vec3> centres_;
    PointGrid grid_;
};

} // namespace abut
