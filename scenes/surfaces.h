#pragma once

#include <abut/mesh.h>

#include "scenes/random.h"
#include "scenes/shapes.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Surfaces of even triangles, and how to turn them: what scenes that deform are made of.
namespace abut::scenes {

/// A flat sheet about the origin, in x and z, facing up: squares about `size` wide, each cut in two,
/// the cuts in turn one way and the other.
Mesh sheet(double length_x, double length_z, double size);

/// The surface that a profile (position on the axis, radius) sweeps about the x axis: a ring of
/// vertices at each point of the profile, one vertex where that lies on the axis. The rings have as
/// many vertices as make their edges about `size` long. Outward where the profile rises with x; the
/// first ring's vertices come first.
Mesh turned_surface(const std::vector<Point2>& profile, double size);
/// A straight profile, in steps that make even triangles.
std::vector<Point2> straight_profile(const Point2& from, const Point2& to, double size);
/// A cylinder with hemispheres on its ends, its axis from the origin to (length, 0, 0). Outward.
Mesh capsule(double length, double radius, double size);

/// The size at which a mesh has about so many triangles; make(size) makes it.
double size_for(std::uint64_t triangles, const std::function<Mesh(double)>& make);

/// Adds a copy of `piece`, moved; returns its first vertex.
std::uint32_t append(Mesh& whole, const Mesh& piece, const Transform& whole_from_piece = {});

/// Cosine and sine of a number of turns, to 1e-6 of a turn; the same on every machine.
Point2 on_circle(double turns);
/// Turns about the x, y or z axis; right-handed.
Transform turned_about_x(double turns);
Transform turned_about_y(double turns);
Transform turned_about_z(double turns);

/// Moves each vertex by some hundredths of the triangles' size: gives folds something to start from,
/// since perfect symmetry would stand on its edge.
void ruffle(std::span<Vec3> positions, double size, Random& random);

/// Rounded to multiples of 2^-20 m, so that a file of floats holds it exactly, up to 16 m.
Vec3 on_float_grid(const Vec3& p);

/// Rises smoothly from 0 to 1 while x does, and stays there.
double smooth_step(double x);

} // namespace abut::scenes
