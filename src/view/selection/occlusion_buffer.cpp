#include "view/selection/occlusion_buffer.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr float kNothing = std::numeric_limits<float>::max();
/// Cells by which images of points may be wrong, and a relative error of depths.
constexpr double kCellError = 1e-4, kDepthError = 1e-5;

int cell_of(double x, int most) {
    return static_cast<int>(std::clamp(std::floor(x), -1.0, double(most)));
}

/// The point of a segment that has this depth.
Vec3 at_depth(const Vec3& a, const Vec3& b, double depth) {
    Vec3 p = a + ((depth - a.z) / (b.z - a.z)) * (b - a);
    p.z = depth;
    return p;
}

std::size_t index_of_cell(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
}

} // namespace

OcclusionBuffer::OcclusionBuffer() {
    for (int w = kWidth, h = kHeight; w >= 1 && h >= 1; w /= 2, h /= 2)
        levels_.emplace_back(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.0F);
    farthest_.assign(levels_[0].size(), kNothing);
    covered_.assign(levels_[0].size(), 0);
}

void OcclusionBuffer::begin(const Camera& camera, const Vec3& origin) {
    frame_ = CameraFrame(camera);
    eye_ = camera.eye - origin;
    near_ = camera.near;
    std::ranges::fill(levels_[0], 0.0F);
}

Vec3 OcclusionBuffer::in_camera(const std::array<float, 3>& point) const {
    const Vec3 d = Vec3{point[0], point[1], point[2]} - eye_;
    return {dot(d, frame_.right), dot(d, frame_.up), dot(d, frame_.forward)};
}

OcclusionBuffer::Point OcclusionBuffer::project(const Vec3& point) const {
    const double w = 1 / point.z;
    return {0.5 * kWidth * (1 + point.x * w / frame_.slope_x),
            0.5 * kHeight * (1 - point.y * w / frame_.slope_y), w};
}

double OcclusionBuffer::cells(const Occluder& occluder) const {
    double square = 0;
    const std::array<double, 3> eye{eye_.x, eye_.y, eye_.z};
    for (std::size_t i = 0; i < 3; ++i) {
        const double gap =
            std::max({0.0, occluder.lower.at(i) - eye.at(i), eye.at(i) - occluder.upper.at(i)});
        square += gap * gap;
    }
    const double per_length = 0.5 * kHeight / frame_.slope_y;
    return occluder.area * per_length * per_length / std::max(square, near_ * near_);
}

std::size_t OcclusionBuffer::draw(const Occluder& occluder) {
    looked_at_ = 0;
    corners_.clear();
    for (const auto& vertex : occluder.vertices)
        corners_.push_back(in_camera(vertex));
    draw_side(occluder, true);
    if (occluder.is_open)
        draw_side(occluder, false);
    return looked_at_;
}

/// Draws the triangles that show the eye their front, or their back.
void OcclusionBuffer::draw_side(const Occluder& occluder, bool front) {
    is_drawn_.assign(occluder.triangles.size(), 0);
    dirty_ = {kWidth, -1, kHeight, -1};
    for (std::size_t t = 0; t < occluder.triangles.size(); ++t) {
        const auto& [a, b, c] = occluder.triangles[t];
        const std::array<Vec3, 3> triangle{corners_[a], corners_[b], corners_[c]};
        const double side =
            dot(triangle[0], cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
        if (!(front ? side < 0 : side > 0))
            continue;
        is_drawn_[t] = 1;
        draw_triangle(triangle);
    }
    for (const Occluder::Edge& edge : occluder.edges) {
        const auto is_drawn = [&](std::uint16_t t) {
            return t != Occluder::kNoTriangle && is_drawn_[t] != 0;
        };
        if (is_drawn(edge.triangles[0]) != is_drawn(edge.triangles[1]))
            mark_edge(corners_[edge.vertices[0]], corners_[edge.vertices[1]]);
    }
    merge();
}

/// Draws what of a triangle is beyond the near plane. Where the plane cuts it is an edge.
void OcclusionBuffer::draw_triangle(const std::array<Vec3, 3>& corners) {
    std::vector<Point> polygon;
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = corners.at(i), &b = corners.at((i + 1) % 3);
        if (a.z >= near_)
            polygon.push_back(project(a));
        if ((a.z >= near_) != (b.z >= near_)) {
            ends.push_back(at_depth(a, b, near_));
            polygon.push_back(project(ends.back()));
        }
    }
    if (polygon.size() < 3)
        return;
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    fill(polygon, normal, dot(normal, corners[0]));
    if (ends.size() == 2)
        mark_segment(project(ends[0]), project(ends[1]));
}

/// Fills a convex polygon of the plane dot(normal, p) = offset.
void OcclusionBuffer::fill(const std::vector<Point>& polygon, const Vec3& normal, double offset) {
    // 1 / depth is linear in the picture: p = depth (slope_x u, slope_y v, 1).
    const double to_x = normal.x * frame_.slope_x / offset,
                 to_y = normal.y * frame_.slope_y / offset;
    const double per_x = 2 * to_x / kWidth, per_y = -2 * to_y / kHeight;
    const double at_corner = normal.z / offset - to_x + to_y;
    double top = HUGE_VAL, bottom = -HUGE_VAL, least = HUGE_VAL;
    for (const Point& p : polygon) {
        top = std::min(top, p.y), bottom = std::max(bottom, p.y);
        least = std::min(least, p.w);
    }
    // The least value in a cell is that in its middle less this; rounding to single precision
    // included.
    const double spread =
        0.5 * (std::abs(per_x) + std::abs(per_y)) +
        0x1p-21 * (std::abs(at_corner) + kWidth * std::abs(per_x) + kHeight * std::abs(per_y));
    const int last = std::min(cell_of(bottom + kCellError, kHeight), kHeight - 1);
    for (int y = std::max(cell_of(top - kCellError, kHeight), 0); y <= last; ++y) {
        double left = HUGE_VAL, right = -HUGE_VAL;               // in the row of cells
        double middle_left = HUGE_VAL, middle_right = -HUGE_VAL; // on its middle
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point *a = &polygon[i], *b = &polygon[(i + 1) % polygon.size()];
            if (a->y > b->y)
                std::swap(a, b);
            const double from = std::max(a->y, y - kCellError);
            const double to = std::min(b->y, y + 1 + kCellError);
            if (from > to)
                continue;
            const bool is_level = !(b->y > a->y);
            const double slope = is_level ? 0 : (b->x - a->x) / (b->y - a->y);
            const double x0 = is_level ? a->x : a->x + slope * (from - a->y);
            const double x1 = is_level ? b->x : a->x + slope * (to - a->y);
            left = std::min({left, x0, x1}), right = std::max({right, x0, x1});
            if (a->y <= y + 0.5 && y + 0.5 < b->y) {
                const double at = a->x + slope * (y + 0.5 - a->y);
                middle_left = std::min(middle_left, at), middle_right = std::max(middle_right, at);
            }
        }
        const int first = std::max(cell_of(left - kCellError, kWidth), 0);
        const int end = std::min(cell_of(right + kCellError, kWidth), kWidth - 1);
        touch(first, end, y);
        const std::size_t row = index_of_cell(0, y, kWidth);
        const auto at_row = static_cast<float>(at_corner + per_y * (y + 0.5) - spread);
        const auto per_cell = static_cast<float>(per_x), floor = static_cast<float>(least);
        float* const farthest = farthest_.data() + row;
        for (int x = first; x <= end; ++x)
            farthest[x] = std::min(
                farthest[x], std::max(at_row + per_cell * (static_cast<float>(x) + 0.5F), floor));
        std::uint32_t* const covered = covered_.data() + row;
        const int from = std::max(cell_of(std::ceil(middle_left - 0.5), kWidth), first);
        const int to = std::min(cell_of(middle_right - 0.5, kWidth), end);
        for (int x = from; x <= to; ++x)
            covered[x] |= 1U;
    }
}

void OcclusionBuffer::mark_edge(const Vec3& a, const Vec3& b) {
    if (a.z < near_ && b.z < near_)
        return;
    mark_segment(project(a.z < near_ ? at_depth(b, a, near_) : a),
                 project(b.z < near_ ? at_depth(a, b, near_) : b));
}

/// Marks all cells that a segment passes through.
void OcclusionBuffer::mark_segment(const Point& from, const Point& to) {
    const Point &a = from.y <= to.y ? from : to, &b = from.y <= to.y ? to : from;
    const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
    const int last = std::min(cell_of(b.y + kCellError, kHeight), kHeight - 1);
    for (int y = std::max(cell_of(a.y - kCellError, kHeight), 0); y <= last; ++y) {
        const double top = std::clamp(double(y) - kCellError, a.y, b.y);
        const double bottom = std::clamp(y + 1 + kCellError, a.y, b.y);
        double left = a.x + slope * (top - a.y), right = a.x + slope * (bottom - a.y);
        if (!(b.y > a.y))
            left = a.x, right = b.x;
        if (left > right)
            std::swap(left, right);
        // A steep slope makes the ends less certain.
        const double error = kCellError * (1 + 1e-8 * std::abs(slope));
        const int x0 = std::max(cell_of(left - error, kWidth), 0);
        const int x1 = std::min(cell_of(right + error, kWidth), kWidth - 1);
        touch(x0, x1, y);
        for (int x = x0; x <= x1; ++x)
            covered_[index_of_cell(x, y, kWidth)] |= 2U;
    }
}

void OcclusionBuffer::touch(int x0, int x1, int y) {
    if (x0 > x1)
        return;
    dirty_.x0 = std::min(dirty_.x0, x0), dirty_.x1 = std::max(dirty_.x1, x1);
    dirty_.y0 = std::min(dirty_.y0, y), dirty_.y1 = std::max(dirty_.y1, y);
    looked_at_ += static_cast<std::size_t>(x1 - x0 + 1);
}

/// Adds the cells that the occluder covers whole, and forgets it.
void OcclusionBuffer::merge() {
    for (int y = dirty_.y0; y <= dirty_.y1; ++y) {
        const std::size_t row = index_of_cell(0, y, kWidth);
        float *const nearest = levels_[0].data() + row, *const farthest = farthest_.data() + row;
        std::uint32_t* const covered = covered_.data() + row;
        for (int x = dirty_.x0; x <= dirty_.x1; ++x) {
            const float w = covered[x] == 1 ? farthest[x] : 0;
            nearest[x] = std::max(nearest[x], w);
            farthest[x] = kNothing;
            covered[x] = 0;
        }
        looked_at_ += static_cast<std::size_t>(std::max(dirty_.x1 - dirty_.x0 + 1, 0));
    }
}

void OcclusionBuffer::finish() {
    int width = kWidth, height = kHeight;
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const std::vector<float>& fine = levels_[level - 1];
        const int w = width / 2, h = height / 2;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                // Of an odd number of cells, the last one joins the one before.
                const int x1 = x == w - 1 ? width - 1 : 2 * x + 1;
                const int y1 = y == h - 1 ? height - 1 : 2 * y + 1;
                float least = kNothing;
                for (int v = 2 * y; v <= y1; ++v)
                    for (int u = 2 * x; u <= x1; ++u)
                        least = std::min(least, fine[index_of_cell(u, v, width)]);
                levels_[level][index_of_cell(x, y, w)] = least;
            }
        width = w, height = h;
    }
}

bool OcclusionBuffer::hides(const std::array<float, 3>& lower,
                            const std::array<float, 3>& upper) const {
    double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL, nearest = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 p = in_camera({(corner & 1U) != 0 ? upper[0] : lower[0],
                                  (corner & 2U) != 0 ? upper[1] : lower[1],
                                  (corner & 4U) != 0 ? upper[2] : lower[2]});
        if (!(p.z > near_))
            return false;
        const Point at = project(p);
        left = std::min(left, at.x), right = std::max(right, at.x);
        top = std::min(top, at.y), bottom = std::max(bottom, at.y);
        nearest = std::max(nearest, at.w);
    }
    int x0 = std::max(cell_of(left - kCellError, kWidth), 0);
    int x1 = std::min(cell_of(right + kCellError, kWidth), kWidth - 1);
    int y0 = std::max(cell_of(top - kCellError, kHeight), 0);
    int y1 = std::min(cell_of(bottom + kCellError, kHeight), kHeight - 1);
    if (x0 > x1 || y0 > y1)
        return false; // outside of the picture
    constexpr int kMostCells = 16;
    std::size_t level = 0;
    int width = kWidth, height = kHeight;
    while (std::max(x1 - x0, y1 - y0) >= kMostCells && level + 1 < levels_.size()) {
        ++level;
        width /= 2, height /= 2;
        x0 = std::min(x0 / 2, width - 1), x1 = std::min(x1 / 2, width - 1);
        y0 = std::min(y0 / 2, height - 1), y1 = std::min(y1 / 2, height - 1);
    }
    const double least = nearest * (1 + kDepthError);
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (!(double{levels_[level][index_of_cell(x, y, width)]} > least))
                return false;
    return true;
}

} // namespace abut
