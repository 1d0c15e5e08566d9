#pragma once

#include <abut/mesh.h>

#include "scenes/cloth.h"
#include "scenes/deforming.h"

#include <functional>
#include <span>
#include <vector>

/// The scenes of cloth: what they start with, and how their bodies move.
namespace abut::scenes {

struct ClothModel {
    Mesh mesh;                ///< cloth and bodies
    std::vector<bool> driven; ///< by vertex
    ClothSettings settings;
    /// Writes where the driven vertices are, so many seconds after the start.
    std::function<void(double, std::span<Vec3>)> drive;
};

/// A square of cloth falls on a ball, which then turns and takes it round.
ClothModel cloth_on_ball(const DeformingOptions& options);
/// A tube whose ends are turned against each other and brought together.
ClothModel twisted_tube(const DeformingOptions& options);
/// A dancing figure in seven skirts, one over the other.
ClothModel dancer(const DeformingOptions& options);
/// A long wide skirt on a figure that steps and turns.
ClothModel skirt(const DeformingOptions& options);

} // namespace abut::scenes
