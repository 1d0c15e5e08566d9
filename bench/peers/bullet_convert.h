#pragma once

#include <abut/types.h>

#include <LinearMath/btTransform.h>
#include <cstddef>

/// Abut's types as Bullet's, in its precision.
namespace abut::bench {

inline btVector3 to_bullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}

inline btTransform to_bullet(const Transform& t) {
    const auto m = [&](std::size_t i) { return static_cast<btScalar>(t.m[i]); };
    return btTransform(btMatrix3x3(m(0), m(3), m(6), m(1), m(4), m(7), m(2), m(5), m(8)),
                       btVector3(m(9), m(10), m(11)));
}

} // namespace abut::bench
