#pragma once

#include <map>
#include <string>

namespace abut::test {

/// The tetrahedron of support.h in every format, by file name. Formats with two encodings have
/// both.
std::map<std::string, std::string> sample_files();

/// A unit cube of six quads as ASCII FBX with a unit of one metre (100 cm).
std::string cube_fbx();

} // namespace abut::test
