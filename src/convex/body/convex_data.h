#pragma once

#include <abut/convex.h>

#include "convex/hull/exact_hull.h"
#include "convex/hull/inner_ball.h"
#include "convex/hull/polytope.h"

#include <vector>

namespace abut {

/// A hull of some of the body's vertices, and so inside it.
struct HullLevel {
    Polytope polytope;
    std::vector<std::uint32_t> number; ///< the number of each vertex among those of the body
    double deviation = 0;              ///< no point of the body is farther than this from this hull
};

/// The data that copies of a Convex share.
class ConvexData {
public:
    /// In          finite points, at least one.
    explicit ConvexData(std::span<const Vec3> points);

    [[nodiscard]] std::size_t bytes() const;

    int dimension = 0;
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> source;
    std::vector<Vec3> left_out; ///< vertices of the exact hull that are not among `vertices`
    double outside = 0;         ///< the greatest distance of these from the hull of `vertices`
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> face_begin, face_vertices;
    std::vector<IndexTriangle> triangles; ///< of the surface

    /// The number of the body's edge that each edge of its polytope lies on, or kNoEdge if it lies
    /// inside a face. And the face of the triangle between it and the next edge around its vertex.
    std::vector<std::uint32_t> edge_number, face_number;
    std::vector<HullLevel> levels; ///< the body's own polytope first, then coarser and coarser ones
    std::size_t entry = 0;         ///< the level where a search without a warm start begins
    double reach = 0;              ///< largest |x| + |y| + |z| of a vertex, with those left out
    InnerBall ball;                ///< radius 0 if the body is flat

private:
    void number_features();
    void simplify();
};

} // namespace abut
