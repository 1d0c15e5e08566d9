#pragma once

#include <abut/deformable.h>
#include <abut/mesh.h>

#include "scenes/deforming/contact.h"
#include "scenes/deforming/deforming.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut::scenes {

/// Units: metres and seconds.
struct ClothSettings {
    Vec3 gravity{0, -9.81, 0};
    double thickness = 0.005; ///< features nearer than this are pushed apart; must be below half an
                              ///< edge, or the cloth pushes against its own next triangle
    double friction = 0.3;    ///< Coulomb's coefficient
    double drag = 0.5;        ///< part of the velocity lost to the air per second
    double bending = 0.02;    ///< part of a fold that one iteration removes, in [0, 1]
    bool hangs = false;       ///< tethers to the driven vertices hold the cloth's weight
};

/// Cloth, and bodies that it meets, in one mesh. Driven vertices move as told. The other vertices
/// have equal mass and are held together by the lengths of their edges.
///
/// Features that are near each other at the start of a frame are kept apart during it. Features
/// that still meet are pushed back, round by round, before the next frame, but a frame shows the
/// cloth before that. So frames contain impacts and shallow penetrations, as do the steps of a
/// simulator when it asks for impacts, and yet the cloth does not get entangled.
///
/// Source      position-based dynamics [Mueller et al. 2007] in small steps [Macklin et al. 2019],
///             with long-range attachments [Kim, Chentanez, Mueller 2012]; contacts in the manner
///             of [Bridson, Fedkiw, Anderson 2002].
class Cloth {
public:
    /// In          the mesh at rest; for each vertex, whether it is driven.
    Cloth(Mesh mesh, const std::vector<bool>& driven, const ClothSettings& settings);

    /// The current frame. Its positions are exact as floats.
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    /// Advances by one frame.
    ///
    /// In          driven_to: for each vertex, its position at the end of the frame; only read for
    ///             driven vertices.
    void step(std::span<const Vec3> driven_to);

private:
    /// Keeps two vertices at the distance `rest`.
    struct Length {
        std::uint32_t a = 0, b = 0;
        double rest = 0, stiffness = 1;
    };
    /// Keeps a vertex within the distance `most` of a driven one.
    struct Tether {
        std::uint32_t vertex = 0, holder = 0;
        double most = 0;
    };
    struct Spacing {
        Contact contact;
        double least = 0; ///< the smallest allowed distance along the normal
    };

    void add_lengths();
    void add_tethers();
    void show();
    void add_length(std::uint32_t a, std::uint32_t b, double stiffness);
    void find_near();
    void substep(std::span<const Vec3> driven_to, double share);
    void keep_lengths();
    void keep_tethers();
    void keep_spacing();
    void push_back_impacts();
    double push(const Contact& contact, double least);
    void rub(const Contact& contact, double push);
    void shift(const Contact& contact, const Vec3& by);

    Mesh mesh_; ///< as shown
    ClothSettings settings_;
    std::vector<Vec3> positions_; ///< after features that met were pushed back
    std::vector<double> inverse_mass_;
    std::vector<Vec3> velocities_;
    std::vector<Vec3> start_;    ///< positions at the start of the frame
    std::vector<Vec3> previous_; ///< positions at the start of the substep
    std::vector<Length> lengths_;
    std::vector<Tether> tethers_;
    std::vector<Spacing> near_;
    Deformable surface_;
};

} // namespace abut::scenes
