#pragma once

#include <abut/convex.h>

#include "math/vector.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The flat faces of a convex body, with what a contact needs of them: normals, numbers of edges,
/// and the faces at each vertex.
///
/// Faces that are coplanar only to rounding, such as those of a box that a file has turned, are one
/// face here: the vertices of a face lie within 2^-40 of the largest coordinate of a plane.
class FaceTable {
public:
    /// A vertex of a face, and the edge from it to the face's next vertex, by their numbers in the
    /// body.
    struct Corner {
        std::uint32_t vertex = 0, edge = 0;
    };

    /// Cost        O(n log n) for n faces.
    explicit FaceTable(const Convex& body);

    /// The unit outward normal of a face.
    [[nodiscard]] const Vec3& normal(std::uint32_t face) const { return normals_[face]; }
    /// The largest dot product of the normal and a corner of the face.
    [[nodiscard]] double offset(std::uint32_t face) const { return offsets_[face]; }
    /// Counter-clockwise, seen from outside.
    [[nodiscard]] std::span<const Corner> corners(std::uint32_t face) const {
        return std::span(corners_).subspan(begin_[face], begin_[face + 1] - begin_[face]);
    }
    /// The faces that a vertex lies on. None for a point or a segment.
    [[nodiscard]] std::span<const std::uint32_t> faces_at(std::uint32_t vertex) const {
        return std::span(faces_).subspan(first_face_[vertex],
                                         first_face_[vertex + 1] - first_face_[vertex]);
    }
    [[nodiscard]] std::size_t size() const { return normals_.size(); }

private:
    std::vector<Vec3> normals_;
    std::vector<double> offsets_;
    std::vector<std::uint32_t> begin_{0}; ///< in `corners_`, for each face and at the end
    std::vector<Corner> corners_;
    std::vector<std::uint32_t> first_face_, faces_;
};

} // namespace abut
