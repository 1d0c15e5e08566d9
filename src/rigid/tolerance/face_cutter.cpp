#include "rigid/tolerance/face_cutter.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace abut {

namespace {

class FacePartition {
public:
    FacePartition(const Triangle& face, const Vec3& normal, double near)
        : normal_(normal), near_(near) {
        nodes_.push_back({{face[0], face[1], face[2]}, {}, {}, 0});
    }

    void insert(const DirectedPiece& line) { insert(0, line.piece, line.along); }

    [[nodiscard]] std::vector<std::vector<Vec3>> pieces() const {
        std::vector<std::vector<Vec3>> pieces;
        for (const Node& node : nodes_)
            if (node.children == 0)
                pieces.push_back(node.polygon);
        return pieces;
    }

private:
    struct Node {
        std::vector<Vec3> polygon;  ///< of a leaf
        Vec3 point, across;         ///< the line that divides the node
        std::uint32_t children = 0; ///< the node under the line; the one over it follows
    };

    void insert(std::uint32_t number, const LinePiece& line, const Vec3& along) {
        const std::uint32_t children = nodes_[number].children;
        if (children == 0)
            return divide(number, line.p, along);
        const double at_p = dot(line.p - nodes_[number].point, nodes_[number].across),
                     at_q = dot(line.q - nodes_[number].point, nodes_[number].across);
        if (std::max(std::abs(at_p), std::abs(at_q)) <= near_)
            return;
        const bool is_p_higher = at_p > at_q;
        if (std::max(at_p, at_q) <= near_) {
            insert(children, line, along);
            if (std::max(at_p, at_q) >= -near_)
                close_neck(children + 1, is_p_higher ? line.p : line.q, along);
            return;
        }
        if (std::min(at_p, at_q) >= -near_) {
            insert(children + 1, line, along);
            if (std::min(at_p, at_q) <= near_)
                close_neck(children, is_p_higher ? line.q : line.p, along);
            return;
        }
        const Vec3 on = line.p + (at_p / (at_p - at_q)) * (line.q - line.p);
        insert(at_p < 0 ? children : children + 1, {line.p, on}, along);
        insert(at_q < 0 ? children : children + 1, {on, line.q}, along);
    }

    /// Divides a leaf at the end of a line, which is near the leaf, where the leaf is not wider than that.
    void close_neck(std::uint32_t number, const Vec3& end, const Vec3& along) {
        const std::uint32_t children = nodes_[number].children;
        if (children != 0) {
            const double at = dot(end - nodes_[number].point, nodes_[number].across);
            if (at <= near_)
                close_neck(children, end, along);
            if (at >= -near_)
                close_neck(children + 1, end, along);
            return;
        }
        const std::vector<Vec3>& polygon = nodes_[number].polygon;
        int sides = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i)
            sides += distance_to_piece(LinePiece{polygon[i], polygon[(i + 1) % polygon.size()]},
                                       end) <= 2 * near_;
        if (sides > 1)
            divide(number, end, along);
    }

    /// Divides a leaf along a line, unless all of it is on one side.
    void divide(std::uint32_t number, const Vec3& on_line, const Vec3& along) {
        const Vec3 across = normalized_or_zero(cross(normal_, along));
        const std::vector<Vec3> polygon = nodes_[number].polygon;
        std::vector<double> height;
        for (const Vec3& corner : polygon) {
            height.push_back(dot(corner - on_line, across));
            if (std::abs(height.back()) <= near_)
                height.back() = 0;
        }
        const auto [lowest, highest] = std::ranges::minmax(height);
        if (lowest >= 0 || highest <= 0)
            return;
        std::vector<Vec3> under, over;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::size_t j = (i + 1) % polygon.size();
            if (height[i] <= 0)
                under.push_back(polygon[i]);
            if (height[i] >= 0)
                over.push_back(polygon[i]);
            if (height[i] * height[j] < 0) {
                const Vec3 on =
                    polygon[i] + (height[i] / (height[i] - height[j])) * (polygon[j] - polygon[i]);
                under.push_back(on);
                over.push_back(on);
            }
        }
        nodes_[number] = {{}, on_line, across, static_cast<std::uint32_t>(nodes_.size())};
        nodes_.push_back({std::move(under), {}, {}, 0});
        nodes_.push_back({std::move(over), {}, {}, 0});
    }

    const Vec3 normal_;
    const double near_;
    std::vector<Node> nodes_;
};

} // namespace

std::vector<std::vector<Vec3>> pieces_of_face(const Triangle& face, const Vec3& normal,
                                              std::span<const DirectedPiece> lines, double near) {
    // Longer lines first: the direction of a short one is less exact. Lines of about one length in a fixed
    // order that mixes those that follow each other, so that the partition is balanced.
    constexpr std::uint32_t kMix = 2654435769; // 2^32 over the golden ratio
    std::vector<std::tuple<int, std::uint32_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < lines.size(); ++i)
        order.emplace_back(-std::ilogb(length(lines[i].piece.q - lines[i].piece.p)), kMix * i, i);
    std::sort(order.begin(), order.end());
    FacePartition partition(face, normal, near);
    for (const auto& [size, mixed, i] : order)
        partition.insert(lines[i]);
    return partition.pieces();
}

} // namespace abut
