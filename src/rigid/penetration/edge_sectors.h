#pragma once

#include "math/vector.h"

#include <vector>

namespace abut {

/// Faces of two solids around a common line, as rays in the plane across it: whose inside lies
/// where.
///
///       inside  a  b           Looking along the line from e0 to e1, faces are rays; their angular
///         of a  |/             order is decided by orientation signs of the stored vertices, so
///      a ------ o              exactly. Here a face of b enters the wedge of a if that wedge lies
///               |              to the right, and stays outside if it lies to the left.
///               b
class EdgeSectors {
public:
    /// A face around the line: its third vertex.
    struct Ray {
        Vec3 apex;
        bool of_a = false;
        int outward = 0; ///< +1: the face's outer side is the one that (e0, e1, apex) turns
                         ///< counter-clockwise to; -1: the other one; 0: not known
    };

    EdgeSectors(const Vec3& e0, const Vec3& e1) : e0_(e0), e1_(e1) {}

    /// Rays along the line itself (degenerate faces) are dropped.
    void add(const Ray& ray);

    /// Whether the interiors share points next to the line. Exact where each solid has one wedge
    /// there.
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
