#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// Decides which pairs of features a query lists, and up to which distance. Those of the first
/// feature's surface come first in all arguments.
class NearRules {
public:
    NearRules(const NearVertices& first, const NearVertices& second, double distance)
        : first_(first), second_(second), distance_(distance),
          have_groups_(!(first.groups.empty() && first.masks.empty() && second.groups.empty() &&
                         second.masks.empty())),
          have_moved_(!(first.moved.empty() && second.moved.empty())) {}

    using Feature = std::span<const std::uint32_t>; ///< the numbers of its vertices

    /// Whether groups, masks and marks of moved vertices admit a pair.
    [[nodiscard]] bool admit(Feature a, Feature b) const {
        return (!have_groups_ || ((groups(first_, a) & masks(second_, b)) != 0 &&
                                  (groups(second_, b) & masks(first_, a)) != 0)) &&
               (!have_moved_ || has_moved(first_, a) || has_moved(second_, b));
    }
    [[nodiscard]] bool admit_all() const { return !have_groups_ && !have_moved_; }
    [[nodiscard]] double limit(Feature a, Feature b) const {
        return distance_ + (thickness(first_, a) + thickness(second_, b));
    }

private:
    static double thickness(const NearVertices& of, Feature feature) {
        double most = 0;
        if (!of.thickness.empty())
            for (const std::uint32_t v : feature)
                most = std::max(most, of.thickness[v]);
        return most;
    }
    static std::uint32_t groups(const NearVertices& of, Feature feature) {
        if (of.groups.empty())
            return 1;
        std::uint32_t all = 0;
        for (const std::uint32_t v : feature)
            all |= of.groups[v];
        return all;
    }
    static std::uint32_t masks(const NearVertices& of, Feature feature) {
        std::uint32_t all = ~0U;
        if (!of.masks.empty())
            for (const std::uint32_t v : feature)
                all &= of.masks[v];
        return all;
    }
    static bool has_moved(const NearVertices& of, Feature feature) {
        return !of.moved.empty() && std::any_of(feature.begin(), feature.end(),
                                                [&](std::uint32_t v) { return of.moved[v] != 0; });
    }

    NearVertices first_, second_;
    double distance_;
    bool have_groups_, have_moved_;
};

/// Errors      Error{bad_argument} if the distance is negative or not finite, or if data of a second
///             surface are given where there is one.
void require_valid_near(double distance, bool is_one_surface, const NearVertices& vertices_b);

/// Errors      Error{bad_argument} if a span has another number of entries than the surface has
///             vertices, or if a thickness is negative or not finite.
void require_valid_vertices(const NearVertices& vertices, const DeformableData& surface);

} // namespace abut
