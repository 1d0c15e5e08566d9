#pragma once

#include <abut/scene.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Returns the largest magnitude of each coordinate in a box; zeros for an empty box.
Vec3 reach_of(const Box3& box);

/// Returns the largest distance by which rounding to single precision has moved a point of a part
/// in the world, in metres; 0 if the part is not rounded.
///
/// In          mesh_reach: reach_of the box of the vertices that triangles use, in the frame that the
///             mesh is stored in.
/// Accuracy    each coordinate is off by at most half the distance of neighbouring floats at the
///             largest coordinate of the mesh: the smaller ones, too, because programs compute one
///             from the others. The result is the largest distance that such errors give under the
///             transform; if transforms are rounded, too, the errors of its entries are added.
double single_rounding(const ModelPrecision& precision, const Vec3& mesh_reach,
                       const Transform& world_from_mesh);

/// Returns how much a length between parts in these boxes may be rounded in double precision, in
/// metres.
double double_rounding(const Box3& a, const Box3& b);

/// The touch tolerance that a pair of parts has if nobody names one: what their files tell apart.
///
/// It is the larger of two lengths. The first is the coarser of the precisions that the two files
/// state: a stated precision is a tolerance for pairs of points, so two of them do not add up. The
/// second is the sum of the roundings of both parts: each surface may lie off by its own, in
/// opposite directions. Roundings and stated precisions are not added either: a program that states
/// a precision compares coordinates after they were rounded.
class PairPrecision {
public:
    /// Adds the next part. Parts are numbered from 0, and those of one model follow each other.
    ///
    /// In          rounding: as single_rounding.
    void add(std::uint32_t model, double stated, double rounding);

    /// The tolerance in metres. A part that was not added is exact.
    [[nodiscard]] double tolerance(std::size_t i, std::size_t k) const;
    /// The sum of both roundings in metres: shorter lengths between the parts mean nothing.
    [[nodiscard]] double rounding(std::size_t i, std::size_t k) const;
    /// An upper bound of tolerance() of all pairs.
    [[nodiscard]] double largest() const;

    /// The largest rounding of a part of a model in metres; 0 for a model without parts.
    [[nodiscard]] double rounding_of_model(std::uint32_t model) const;

    /// What decides tolerance(i, k).
    struct Origin {
        std::uint32_t model = 0; ///< with the coarser precision, or with the larger rounding
        bool stated = false;     ///< whether a stated precision decides
    };
    [[nodiscard]] Origin origin(std::size_t i, std::size_t k) const;

    /// Bytes in memory.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Run {
        std::size_t first = 0; ///< its parts are those from here to the next run's first
        std::uint32_t model = 0;
        double stated = 0;
        double most_rounding = 0;
    };
    [[nodiscard]] Run run_of(std::size_t part) const;
    [[nodiscard]] double of(std::size_t part) const {
        return part < roundings_.size() ? double{roundings_[part]} : 0;
    }

    std::vector<Run> runs_;
    std::vector<float> roundings_; ///< by part, rounded up
    double most_stated_ = 0, most_rounding_ = 0;
};

} // namespace abut
