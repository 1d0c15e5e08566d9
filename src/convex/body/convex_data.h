#pragma once

#include <abut/convex.h>

#include "convex/hull/exact_hull.h"
#include "convex/hull/inner_ball.h"
#include "convex/hull/polytope.h"

#include <vector>

namespace abut {

/// A hull of some of the body's vertices, so inside of it.
struct HullLevel {
    Polytope polytope;
    std::vector<std::uint32_t> number; ///< of each vertex, among those of the body
    double deviation = 0;              ///< no point of the body is farther than that from this hull
};

/// What a Convex shares among its copies.
class ConvexData {
public:
    /// In          finite points, at least one.
    explicit ConvexData(std::span<const Vec3> points);

    [[nodiscard]] std::size_t bytes() const;

    int dimension = 0;
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> source;
    std::vector<Vec3> left_out; ///< vertices of the exact hull that `vertices` does without
    double outside = 0;         ///< none of these lies farther from the hull of `vertices`
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> face_begin, face_vertices;
    std::vector<IndexTriangle> triangles; ///< of the surface

    /// What each edge of the body's polytope is an edge of, or kNoEdge if it lies in a face; and
    /// the face of the triangle between it and the next around its vertex.
    std::vector<std::uint32_t> edge_number, face_number;
    std::vector<HullLevel> levels; ///< the body's own polytope first, then ever coarser ones
    std::size_t entry = 0;         ///< the level where an incoherent search begins
    double reach = 0;              ///< largest |x| + |y| + |z| of a vertex, of those left out too
    InnerBall ball;                ///< radius 0 if the body is flat

private:
    void number_features();
    void simplify();
};

} // namespace abut
