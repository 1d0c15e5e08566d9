#pragma once

#include <abut/mesh.h>

#include "scenes/random.h"
#include "scenes/shapes.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Surfaces with triangles of even size, and rotations: the components of deforming scenes.
namespace abut::scenes {

/// A flat sheet around the origin, in x and z, facing up. It consists of squares about `size` wide,
/// each cut in two along alternating diagonals.
Mesh sheet(double length_x, double length_z, double size);

/// The surface that a profile (position on the axis, radius) sweeps about the x axis. Each point of
/// the profile gives a ring of vertices, or one vertex if it lies on the axis. Rings have edges
/// about `size` long. The surface faces outward if the profile rises with x. The first ring's
/// vertices come first.
Mesh turned_surface(const std::vector<Point2>& profile, double size);
/// A straight profile, in steps that give triangles of even shape.
std::vector<Point2> straight_profile(const Point2& from, const Point2& to, double size);
/// A cylinder with hemispheres on its ends, facing outward. Its axis runs from the origin to
/// (length, 0, 0).
Mesh capsule(double length, double radius, double size);

/// The size at which make(size) returns a mesh of about this many triangles.
double size_for(std::uint64_t triangles, const std::function<Mesh(double)>& make);

/// Adds a copy of `piece`, moved by the transform. Returns its first vertex.
std::uint32_t append(Mesh& whole, const Mesh& piece, const Transform& whole_from_piece = {});

/// Cosine and sine of an angle in turns, to 1e-6 of a turn. They are the same on every machine.
Point2 on_circle(double turns);
/// Right-handed rotations about the x, y and z axis, by an angle in turns.
Transform turned_about_x(double turns);
Transform turned_about_y(double turns);
Transform turned_about_z(double turns);

/// Moves each vertex by some hundredths of the triangles' size, so that folds have something to
/// start from. Perfectly symmetric cloth would stand on its edge.
void ruffle(std::span<Vec3> positions, double size, Random& random);

/// Rounds to multiples of 2^-20 m, which a float holds exactly up to 16 m.
Vec3 on_float_grid(const Vec3& p);

/// Rises smoothly from 0 to 1 for x in [0, 1]; constant outside.
double smooth_step(double x);

} // namespace abut::scenes
