#pragma once

#include "math/vector.h"

#include <vector>

namespace abut {

/// The faces of two solids around a common line, as rays in the plane perpendicular to it.
///
///       inside  a  b           Looking along the line from e0 to e1, faces are rays; their angular
///         of a  |/             order is decided by orientation signs of the stored vertices, so
///      a ------ o              exactly. Here a face of b enters the wedge of a if that wedge lies
///               |              to the right, and stays outside if it lies to the left.
///               b
///
/// Decides whether the solids' interiors share points next to the line.
class EdgeSectors {
public:
    /// A face around the line: its third vertex.
    struct Ray {
        Vec3 apex;
        bool of_a = false;
        /// The face's outer side. +1: the one to which (e0, e1, apex) turns counter-clockwise; -1:
        /// the other one; 0: not known.
        int outward = 0;
    };

    EdgeSectors(const Vec3& e0, const Vec3& e1) : e0_(e0), e1_(e1) {}

    /// Adds a face. One whose ray lies along the line itself (a degenerate face) is dropped.
    void add(const Ray& ray);

    /// Returns whether the interiors share points next to the line. Exact if each solid has one
    /// wedge there.
    [[nodiscard]] bool interiors_overlap();

private:
    [[nodiscard]] int half_turn(const Vec3& apex) const;
    [[nodiscard]] bool before(const Ray& r, const Ray& s) const;
    void sort();
    [[nodiscard]] bool interiors_share_a_face() const;
    [[nodiscard]] bool enters(bool of_a) const;

    Vec3 e0_, e1_;
    std::vector<Ray> rays_;
    std::vector<int> angle_; ///< rank of each ray; equal angles share a rank
};

} // namespace abut
