#pragma once

#include <abut/model.h>

#include "tests/support/shapes.h"

namespace abut::test {

inline const Model kBox(box_mesh({0, 0, 0}, {1, 1, 1}));

} // namespace abut::test
