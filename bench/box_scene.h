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
    planes,    ///< standing on ten floors: equal coordinates
    sizes,     ///< uniform, sides from a tenth of the mean to six times it
};

/// Boxes in motion, about ten partners each.
class BoxScene {
public:
    BoxScene(BoxLayout layout, std::size_t count, std::uint64_t seed);

    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }
    /// Every box moves in its own direction, by about 2 % of the mean side, and turns at the walls.
    void drift();
    /// Every box goes elsewhere.
    void teleport();

private:
    double draw(double low, double high);
    Vec3 draw_point();
    Box3 draw_box();
    void add_spanning_box();

    BoxLayout layout_;
    std::mt19937_64 random_;
    double side_;
    std::vector<Vec3> centres_; ///< of clusters
    std::vector<Box3> boxes_;
    std::vector<Vec3> velocities_;
};

} // namespace abut::bench
