#pragma once

#include <abut/mesh.h>

#include <string>
#include <vector>

namespace abut::bench {

struct NamedMesh {
    std::string name;
    Mesh mesh;
};

/// Closed solids like parts of machines. They consist of few convex pieces.
std::vector<NamedMesh> machine_parts();

} // namespace abut::bench
