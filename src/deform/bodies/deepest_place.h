#pragma once

#include "math/vector.h"

#include <functional>

namespace abut {

/// The value of a function at a point, and a vector along which it rises no faster than it does: for
/// every q, f(q) >= value + dot(gradient, q - point).
struct ConvexSample {
    double value = 0;
    Vec3 gradient;
};

/// Finds the point of a triangle where a convex function is least.
///
/// In          function: convex on the triangle. start: a point of the triangle.
/// Accuracy    the value is at most `tolerance` above the least one, unless 80 samples do not
///             suffice. A piecewise linear function needs a few samples for each of its faces near
///             the place; a smooth one some 25, and 60 at most in tests, for 44 bits.
/// Cost        4 to 80 samples, and after each a linear program in the triangle's weights: half a
///             microsecond.
/// Source      cutting planes [Kelley 1960]. Every linear program contains the last sample's plane,
///             so only corners on that plane are tried. Differs: only the six planes are kept that
///             are highest at the last place; the planes that determine it are among them.
Vec3 deepest_place(const Triangle& triangle, const Vec3& start,
                   const std::function<ConvexSample(const Vec3&)>& function, double tolerance);

} // namespace abut
