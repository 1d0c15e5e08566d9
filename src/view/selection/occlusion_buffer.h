#pragma once

#include <abut/camera.h>

#include "view/camera/camera_frame.h"
#include "view/selection/occluder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A coarse picture of what is certainly covered, and how far away at most.
///
/// It never hides what is visible. Of an occluder, the triangles that face the eye are drawn. Their
/// image can end only at the images of edges that one of them alone has. So a cell is covered whole
/// if its middle is covered and no such edge passes through it. Its depth is the largest that one
/// of the triangles has in it.
class OcclusionBuffer {
public:
    static constexpr int kWidth = 256, kHeight = 144;

    OcclusionBuffer();

    /// Begins a picture without occluders.
    void begin(const Camera& camera, const Vec3& origin);
    /// Draws an occluder. Returns the number of cells that were looked at.
    std::size_t draw(const Occluder& occluder);
    /// Ends drawing.
    void finish();
    /// Returns whether the part of the box that is in the picture is certainly behind occluders.
    [[nodiscard]] bool hides(const std::array<float, 3>& lower,
                             const std::array<float, 3>& upper) const;
    /// Largest number of cells that the box of an occluder can cover, roughly.
    [[nodiscard]] double cells(const Occluder& occluder) const;

private:
    /// A point in the picture: cells from the left and from the top, and 1 / depth.
    struct Point {
        double x = 0, y = 0, w = 0;
    };
    struct Cells {
        int x0 = 0, x1 = -1, y0 = 0, y1 = -1; ///< inclusive
    };
    [[nodiscard]] Vec3 in_camera(const std::array<float, 3>& point) const;
    [[nodiscard]] Point project(const Vec3& point) const;
    void draw_side(const Occluder& occluder, bool front);
    void draw_triangle(const std::array<Vec3, 3>& corners);
    void fill(const std::vector<Point>& polygon, const Vec3& normal, double offset);
    void mark_edge(const Vec3& a, const Vec3& b);
    void mark_segment(const Point& a, const Point& b);
    void merge();
    void touch(int x0, int x1, int y);

    CameraFrame frame_{Camera{}};
    Vec3 eye_; ///< world minus origin
    double near_ = 0;
    std::vector<std::vector<float>>
        levels_; ///< 1 / depth; each next one has a quarter of the cells
    // The occluder that is being drawn:
    std::vector<float> farthest_;        ///< 1 / largest depth of its triangles in the cell
    std::vector<std::uint32_t> covered_; ///< 1: the middle is covered; 2: an edge passes
    Cells dirty_;
    std::vector<Vec3> corners_;
    std::vector<std::uint8_t> is_drawn_; ///< by triangle
    std::size_t looked_at_ = 0;
};

} // namespace abut
