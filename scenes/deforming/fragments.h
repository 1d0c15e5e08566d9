#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::scenes {

/// A part of a solid: some of its fragments, still joined.
struct Piece {
    Mesh shape;                   ///< closed, facing outward, about its centre
    Vec3 centre;                  ///< centre of mass, in the solid's frame
    double mass = 0, inertia = 0; ///< inertia: the mean over all axes
};

/// A solid ball of cells: a lattice of cubes, bent to a ball. Each cell belongs to the fragment
/// with the nearest seed. The ball can crack between fragments.
class FragmentedBall {
public:
    /// In          triangles: of all fragments together, each as a separate piece.
    FragmentedBall(double radius, std::uint64_t triangles, std::uint64_t seed);

    [[nodiscard]] std::size_t fragments() const { return seeds_.size(); }
    /// The approximate size of a cell.
    [[nodiscard]] double cell_size() const;
    /// The group of each fragment, numbered from 0, after cracks have spread from a point to a
    /// distance of `reach`. Fragments between which no crack has run stay in one group.
    [[nodiscard]] std::vector<std::uint32_t> groups(const Vec3& from, double reach) const;
    /// The piece made of the fragments f with group[f] == g. Its vertices on cracks are moved back
    /// a little, so that pieces do not touch.
    [[nodiscard]] Piece piece(std::span<const std::uint32_t> group, std::uint32_t g) const;

private:
    using Index3 = std::array<int, 3>; ///< of a cell, or of a lattice point, by its position

    /// The bond between two fragments.
    struct Bond {
        std::uint32_t a = 0, b = 0;
        Vec3 at;
        double toughness = 1; ///< factor on the distance at which a crack breaks the bond
    };

    void choose_cells(std::uint64_t triangles);
    [[nodiscard]] double divide(const Index3& cells);
    void find_bonds(std::uint64_t seed);
    void place_points();
    void smooth_cracks();
    /// The fragment of a cell; kNone outside the ball.
    [[nodiscard]] std::uint32_t fragment_at(const Index3& cell) const;
    [[nodiscard]] std::size_t point_index(const Index3& point) const;
    [[nodiscard]] Vec3 bent(const Vec3& lattice) const;
    [[nodiscard]] Vec3 centre(const Index3& cell) const;

    double radius_ = 0;
    std::vector<Vec3> seeds_;
    Index3 cells_{};                      ///< number along x, y and z
    std::vector<std::uint32_t> fragment_; ///< of each cell, x fastest
    std::vector<Bond> bonds_;
    std::vector<Vec3> points_; ///< lattice points, x fastest
};

} // namespace abut::scenes
