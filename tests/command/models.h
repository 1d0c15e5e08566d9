#pragma once

#include <abut/scene.h>

#include <string>

/// Small models whose answers are known by hand.
namespace abut::test {

/// The closed box from (0, 0, 0) to (1, 1, 1): 12 triangles that face outwards.
Mesh unit_box();

/// A ball of radius 1 with about 2 * rings^2 triangles.
Mesh ball(int rings);

/// A translation with a uniform scale.
Transform placed(double x, double y, double z, double scale = 1);

/// A part whose id and name are `id`.
Part part(const std::string& id, const std::string& type, std::uint32_t mesh, const Transform& at);

/// The unit box as the text of an OBJ file.
std::string box_obj();

/// One pair of boxes of each kind at a clearance of 0.05, far from each other: hard, "h1" and "h2"
/// (0.1 deep), then touch, contained, duplicate and clearance (0.03 apart).
Scene one_of_each_kind();

/// A crowd of balls in which each meets some others. No two balls share a mesh.
Scene crowd(int balls, int rings);

} // namespace abut::test
