#pragma once

#include <abut/deformable.h>

#include "tests/support/oracle/exact_oracle.h"

#include <optional>

namespace abut::test {

/// The contact by its definition, in integers.
inline std::optional<EdgeFaceContact> true_contact(const Vec3& p, const Vec3& q,
                                                   const Triangle& t) {
    const std::array<Vec3, 2> edge{p, q};
    const Differences<BigInt> differences(edge, t);
    if (!differences.hold_origin())
        return {};
    const std::array<Vec3, 5> all{p, q, t[0], t[1], t[2]};
    const auto points = as_integers<BigInt>(all);
    const auto normal = test::cross(minus(points[3], points[2]), minus(points[4], points[2]));
    if (is_zero(normal) || p == q)
        return EdgeFaceContact::touching;
    const int side_p = sign_of(test::dot(normal, minus(points[0], points[2]))),
              side_q = sign_of(test::dot(normal, minus(points[1], points[2])));
    if (side_p == 0 && side_q == 0)
        return EdgeFaceContact::coplanar;
    return differences.surround_origin() ? EdgeFaceContact::crossing : EdgeFaceContact::touching;
}

} // namespace abut::test
