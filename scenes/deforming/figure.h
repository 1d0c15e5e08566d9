#pragma once

#include <abut/mesh.h>

#include <array>
#include <span>

/// A figure of capsules that do not touch each other. Clothes hang on it.
namespace abut::scenes {

/// The pose of a figure. Angles are in turns; if all are 0, it stands upright with arms hanging.
struct Stance {
    struct Side {
        double hip = 0;    ///< thigh forward
        double knee = 0;   ///< shank backward
        double spread = 0; ///< arm outward
        double swing = 0;  ///< arm forward
        double elbow = 0;  ///< forearm forward
    };
    Side left, right;
    Transform world_from_figure;
};

/// A figure. Its own frame: metres, y up, feet on the ground, facing +z, its left at +x.
class Figure {
public:
    static constexpr double kTorsoRadius = 0.14;
    static constexpr double kWaist = 1.06; ///< height of the waist; the torso is a cylinder up to
                                           ///< 0.25 above

    /// In          size: of its triangles.
    explicit Figure(double size);

    /// The figure standing upright.
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    /// Writes the positions of its vertices in a pose.
    void place(const Stance& stance, std::span<Vec3> positions) const;

private:
    static constexpr std::size_t kLimbs = 10;

    std::array<Mesh, kLimbs> limbs_;
    Mesh mesh_;
};

} // namespace abut::scenes
