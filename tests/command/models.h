#pragma once

#include <abut/scene.h>

#include <string>

/// Small models whose answers are known by hand.
namespace abut::test {

/// The box from (0, 0, 0) to (1, 1, 1), closed, 12 triangles, outward.
Mesh unit_box();

/// A ball of radius 1 made of 2 * rings * rings triangles or so.
Mesh ball(int rings);

/// The box under a translation and a uniform scale.
Transform placed(double x, double y, double z, double scale = 1);

/// A part of a scene; id and name are `id`.
Part part(const std::string& id, const std::string& type, std::uint32_t mesh, const Transform& at);

/// The unit box as the text of an OBJ file.
std::string box_obj();

/// One pair of boxes of each kind at a clearance of 0.05, far from each other: hard "h1" and "h2"
/// (0.1 deep), touch, contained, duplicate, clearance (0.03 apart).
Scene one_of_each_kind();

/// Balls so crowded that each meets some others; none is the same mesh as another.
Scene crowd(int balls, int rings);

} // namespace abut::test
