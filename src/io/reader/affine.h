#pragma once

#include <abut/types.h>

#include <cstddef>

namespace abut {

/// Applies b, then a: world_from_parent and parent_from_child give world_from_child.
inline Transform compose(const Transform& a, const Transform& b) {
    Transform result;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const double* const c = &b.m[3 * column];
            result.m[3 * column + row] = a.m[row] * c[0] + a.m[3 + row] * c[1] +
                                         a.m[6 + row] * c[2] + (column == 3 ? a.m[9 + row] : 0.0);
        }
    return result;
}

} // namespace abut
