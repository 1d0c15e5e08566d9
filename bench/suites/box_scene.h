#pragma once

#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace abut::bench {

/// How the boxes of a case are placed.
enum class BoxLayout : std::uint8_t {
    uniform,   ///< anywhere in the unit cube
    clustered, ///< a thousand to a cluster, clusters anywhere
    spanned,   ///< uniform, and one box around the world
    crossed,   ///< uniform, and a hundred boxes around the world
    planes,    ///< standing on ten floors, so that coordinates are equal
    sizes,     ///< uniform, with sides from a tenth of the mean to six times the mean
    piles,     ///< piles of twenty, anywhere; each box touches the next, at equal coordinates
    heap,      ///< equal boxes, one beside the other, each off its place by up to 5 %
};

/// How boxes move from step to step.
enum class BoxMotion : std::uint8_t {
    coherent, ///< each moves in its own direction, by about 2 % of the mean side (in the heap
              ///< 0.2 %), and turns at walls
    teleport, ///< all boxes jump to other places
    bursts,   ///< coherent, and in every fifth step a tenth of the boxes jumps to other places
    resets,   ///< coherent, and in every fifth step all boxes jump to other places
};

/// Boxes in motion, each with about ten partners.
class BoxScene {
public:
    BoxScene(BoxLayout layout, std::size_t count, std::uint64_t seed);

    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }
    void step(BoxMotion motion);

private:
    void drift();
    /// Replaces the boxes from index `first` on, `stride` apart.
    void teleport(std::size_t first, std::size_t stride);
    double draw(double low, double high);
    Vec3 draw_point(std::size_t index);
    Box3 draw_box(std::size_t index);
    void draw_centres();
    void add_spanning_boxes();
    [[nodiscard]] bool stands() const;

    BoxLayout layout_;
    std::mt19937_64 random_;
    double side_;
    std::size_t count_ = 0;
    std::size_t steps_ = 0;
    std::vector<Vec3> centres_; ///< of clusters and piles
    std::vector<Box3> boxes_;
    std::vector<Vec3> velocities_;
};

} // namespace abut::bench
