#pragma once

#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace abut::bench {

/// Where the boxes of a case lie.
enum class BoxLayout : std::uint8_t {
    uniform,   ///< anywhere in the unit cube
    clustered, ///< a thousand to a cluster, clusters anywhere
    spanned,   ///< uniform, and one box around the world
    crossed,   ///< uniform, and a hundred boxes around the world
    planes,    ///< standing on ten floors: equal coordinates
    sizes,     ///< uniform, sides from a tenth of the mean to six times it
    piles, ///< twenty on each other, piles anywhere: each touches the next, at equal coordinates
};

/// What boxes do from step to step.
enum class BoxMotion : std::uint8_t {
    coherent, ///< each moves in its own direction, by about 2 % of the mean side, and turns at walls
    teleport, ///< all go elsewhere
    bursts,   ///< coherent, and in every fifth step a tenth goes elsewhere: removed and added
    resets,   ///< coherent, and in every fifth step all go elsewhere
};

/// Boxes in motion, about ten partners each.
class BoxScene {
public:
    BoxScene(BoxLayout layout, std::size_t count, std::uint64_t seed);

    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }
    void step(BoxMotion motion);

private:
    void drift();
    /// The boxes from one index on, `stride` apart.
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
