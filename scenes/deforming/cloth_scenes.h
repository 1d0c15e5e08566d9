#pragma once

#include <abut/mesh.h>

#include "scenes/deforming/cloth.h"
#include "scenes/deforming/deforming.h"

#include <functional>
#include <span>
#include <vector>

/// The cloth scenes: their initial meshes, and the motion of their bodies.
namespace abut::scenes {

struct ClothModel {
    Mesh mesh;                ///< cloth and bodies
    std::vector<bool> driven; ///< for each vertex
    ClothSettings settings;
    /// Writes the positions of the driven vertices at a time in seconds after the start.
    std::function<void(double, std::span<Vec3>)> drive;
};

/// A square of cloth falls on a ball, which then turns and takes it along.
ClothModel cloth_on_ball(const DeformingOptions& options);
/// A tube whose ends are twisted against each other and brought together.
ClothModel twisted_tube(const DeformingOptions& options);
/// A dancing figure in seven skirts, one over the other.
ClothModel dancer(const DeformingOptions& options);
/// A long, wide skirt on a figure that steps and turns.
ClothModel skirt(const DeformingOptions& options);

} // namespace abut::scenes
