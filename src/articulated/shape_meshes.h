#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

namespace abut {

/// A polyhedron that encloses a shape.
struct EnclosingMesh {
    Mesh mesh;
    double excess = 0; ///< no point of it is farther than this from the shape
};

/// The box with these edge lengths, around the origin. Exact if halves of the lengths are.
Mesh box_mesh(const Vec3& size);

/// The prism of 64 sides around a cylinder with the axis z, which is centred at the origin.
EnclosingMesh cylinder_mesh(double radius, double length);

/// A polyhedron of 1,280 triangles around a sphere at the origin.
EnclosingMesh sphere_mesh(double radius);

/// Multiplies the coordinates. Turns triangles over if the scale mirrors them.
void scale_mesh(Mesh& mesh, const Vec3& scale);

} // namespace abut
