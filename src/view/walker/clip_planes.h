#pragma once

#include "math/vector.h"

#include <boost/container/static_vector.hpp>

namespace abut {

/// The planes that a body slides along in one step.
class ClipPlanes {
public:
    static constexpr std::size_t kMost = 6;

    /// Adds a plane by its normal, which points to the body's side.
    void add(const Vec3& normal) {
        if (normals_.size() < kMost)
            normals_.push_back(normal);
    }
    [[nodiscard]] bool full() const { return normals_.size() == kMost; }

    /// The part of a way that goes behind none of the planes: along one plane, or along the line
    /// that two share; zero if that leaves nothing.
    [[nodiscard]] Vec3 clipped(const Vec3& way) const {
        if (is_allowed(way))
            return way;
        for (const Vec3& n : normals_) {
            const Vec3 along = way - dot(way, n) * n;
            if (dot(way, n) < 0 && is_allowed(along))
                return along;
        }
        for (std::size_t i = 0; i < normals_.size(); ++i)
            for (std::size_t j = i + 1; j < normals_.size(); ++j) {
                const Vec3 line = normalized_or_zero(cross(normals_[i], normals_[j]));
                const Vec3 along = dot(way, line) * line;
                if (is_allowed(along) && dot(along, way) > 0)
                    return along;
            }
        return {};
    }

private:
    [[nodiscard]] bool is_allowed(const Vec3& way) const {
        constexpr double kRounding = 1e-12;
        for (const Vec3& n : normals_)
            if (dot(way, n) < -kRounding * length(way))
                return false;
        return true;
    }

    boost::container::static_vector<Vec3, kMost> normals_;
};

} // namespace abut
