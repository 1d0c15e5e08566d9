#pragma once

#include "tests/support/paths.h"

#include <string>

namespace abut::test {

/// Holds the IFC files of these tests.
inline const std::string kFolder = std::string(ABUT_SOURCE_DIR) + "/tests/io/";

} // namespace abut::test
