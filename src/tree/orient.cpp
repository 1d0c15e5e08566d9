#include "tree/orient.h"

#include "core/parallel.h"
#include "math/rounding.h"
#include "math/vector.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr std::size_t kLanes = TriangleLeaf::kLanes;
/// A node with more slots than this keeps the tree's axes. A large part of a surface has no single
/// direction, and every further level would cost a pass over the triangles.
constexpr std::uint32_t kMostSlots = 2048;

/// A run of leaves, with the area of its triangles and their first and second moments about the
/// tree's origin.
struct Moments {
    std::uint32_t first = ~0U, end = 0; ///< slots
    double area = 0;
    Vec3 first_moment;
    double second[6] = {}; ///< xx, yy, zz, xy, xz, yz

    void merge(const Moments& other) {
        first = std::min(first, other.first);
        end = std::max(end, other.end);
        area += other.area;
        first_moment = first_moment + other.first_moment;
        for (std::size_t i = 0; i < 6; ++i)
            second[i] += other.second[i];
    }
};

Vec3 vertex(const TriangleLeaf& leaf, std::size_t vertex, std::size_t lane) {
    return {leaf.v[vertex][0][lane], leaf.v[vertex][1][lane], leaf.v[vertex][2][lane]};
}

/// Adds a triangle. The integral of x x^T over it is (9 c c^T + p p^T + q q^T + r r^T) area / 12,
/// where c is the centroid.
void add_triangle(const TriangleLeaf& leaf, std::size_t lane, Moments& m) {
    const Vec3 p = vertex(leaf, 0, lane), q = vertex(leaf, 1, lane), r = vertex(leaf, 2, lane);
    const double area = length(cross(q - p, r - p));
    const Vec3 c = (1.0 / 3) * (p + q + r);
    m.area += area;
    m.first_moment = m.first_moment + area * c;
    const auto add = [&](const Vec3& x, double w) {
        m.second[0] += w * x.x * x.x;
        m.second[1] += w * x.y * x.y;
        m.second[2] += w * x.z * x.z;
        m.second[3] += w * x.x * x.y;
        m.second[4] += w * x.x * x.z;
        m.second[5] += w * x.y * x.z;
    };
    add(c, area * 9 / 12);
    for (const Vec3& x : {p, q, r})
        add(x, area / 12);
}

/// Principal axes of the surface about its centroid. False if there are none, or if they are the
/// tree's axes.
bool principal_frame(const Moments& m, NodeFrame& frame) {
    if (!(m.area > 0))
        return false;
    const Vec3 mean = (1 / m.area) * m.first_moment;
    const double s = 1 / m.area;
    Eigen::Matrix3d covariance;
    covariance(0, 0) = s * m.second[0] - mean.x * mean.x;
    covariance(1, 1) = s * m.second[1] - mean.y * mean.y;
    covariance(2, 2) = s * m.second[2] - mean.z * mean.z;
    covariance(0, 1) = covariance(1, 0) = s * m.second[3] - mean.x * mean.y;
    covariance(0, 2) = covariance(2, 0) = s * m.second[4] - mean.x * mean.z;
    covariance(1, 2) = covariance(2, 1) = s * m.second[5] - mean.y * mean.z;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    const auto& v = solver.eigenvectors();
    const Vec3 z = normalized_or_zero({v(0, 0), v(1, 0), v(2, 0)});
    const Vec3 along{v(0, 2), v(1, 2), v(2, 2)};
    const Vec3 x = normalized_or_zero(along - dot(along, z) * z);
    const Vec3 y = cross(z, x);
    if (!(std::abs(length_sq(y) - 1) < 0x1p-40 && std::abs(length_sq(z) - 1) < 0x1p-40))
        return false;
    const auto column = [](double a, double b, double c) {
        return std::array{to_float(a), to_float(b), to_float(c), 0.0F};
    };
    frame.turn = {column(x.x, y.x, z.x), column(x.y, y.y, z.y), column(x.z, y.z, z.z)};
    frame.origin = {to_float(mean.x), to_float(mean.y), to_float(mean.z)};
    return frame.turn != NodeFrame().turn;
}

/// Box of the triangles of some slots in a frame. Rounding is not accounted for.
Aabb box_of(const Tree& tree, const NodeFrame& frame, std::uint32_t first, std::uint32_t end) {
    struct alignas(16) Lanes {
        float v[kLanes];
    };
    Lanes lower[3], upper[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            lower[axis].v[lane] = std::numeric_limits<float>::infinity(),
            upper[axis].v[lane] = -std::numeric_limits<float>::infinity();
    for (std::uint32_t slot = first; slot < end; slot += kLanes) {
        const TriangleLeaf& leaf = tree.leaves[slot / kLanes];
        for (const auto& v : leaf.v) {
            Lanes d[3];
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t lane = 0; lane < kLanes; ++lane)
                    d[k].v[lane] = v[k][lane] - frame.origin[k];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto& turn = frame.turn;
                Lanes x{};
                for (std::size_t lane = 0; lane < kLanes; ++lane)
                    x.v[lane] = turn[0][axis] * d[0].v[lane] + turn[1][axis] * d[1].v[lane] +
                                turn[2][axis] * d[2].v[lane];
                for (std::size_t lane = 0; lane < kLanes; ++lane) {
                    lower[axis].v[lane] =
                        x.v[lane] < lower[axis].v[lane] ? x.v[lane] : lower[axis].v[lane];
                    upper[axis].v[lane] =
                        x.v[lane] > upper[axis].v[lane] ? x.v[lane] : upper[axis].v[lane];
                }
            }
        }
    }
    Aabb box;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            box.lower[axis] = std::min(box.lower[axis], lower[axis].v[lane]);
            box.upper[axis] = std::max(box.upper[axis], upper[axis].v[lane]);
        }
    return box;
}

float reach_of(const Aabb& box) {
    float reach = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        reach = std::max({reach, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
    return reach;
}

class Orienter {
public:
    Orienter(Tree& tree, const TreeMesh& mesh, OwnAxes own_axes)
        : tree_(tree), mesh_(mesh), own_axes_(own_axes),
          position_rounding_(0x1p-23F * reach_of(tree.bounds)) {}

    void run() {
        if (own_axes_ != OwnAxes::never)
            gather_moments();
        const std::size_t count = tree_.nodes.size();
        parallel_for(count, 64, [&](std::size_t i) { fit(i); });
        parallel_for(count, 64, [&](std::size_t i) { turn_leaves(tree_.nodes[i]); });
        for (std::size_t axis = 0; axis < 3; ++axis) {
            tree_.bounds.lower[axis] -= position_rounding_;
            tree_.bounds.upper[axis] += position_rounding_;
        }
    }

private:
    [[nodiscard]] Moments of_leaf(NodeRef leaf) const {
        Moments m;
        m.first = leaf.first();
        m.end = leaf.first() + kLanes;
        for (std::size_t lane = 0; lane < leaf.count(); ++lane)
            add_triangle(tree_.leaf(leaf), lane, m);
        return m;
    }

    /// Marks the nodes that may get their own axes, and all nodes below them.
    [[nodiscard]] std::vector<std::uint8_t> with_moments() const {
        std::vector<std::uint8_t> wanted(tree_.nodes.size(), 1);
        if (own_axes_ == OwnAxes::where_smaller)
            return wanted;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            wanted[i] = tree_.nodes[i].frame.turned ? 1 : 0;
        // Children come after their parent.
        for (std::size_t i = 0; i < wanted.size(); ++i)
            for (const NodeRef child : tree_.nodes[i].child)
                if (wanted[i] != 0 && !child.is_none() && !child.is_leaf())
                    wanted[child.index()] = 1;
        return wanted;
    }

    void gather_moments() {
        moments_.resize(tree_.nodes.size());
        const std::vector<std::uint8_t> wanted = with_moments();
        const auto gather = [&](std::size_t i, bool leaves) {
            if (wanted[i] == 0)
                return;
            for (const NodeRef child : tree_.nodes[i].child)
                if (!child.is_none() && child.is_leaf() == leaves)
                    moments_[i].merge(leaves ? of_leaf(child) : moments_[child.index()]);
        };
        parallel_for(moments_.size(), 64, [&](std::size_t i) { gather(i, true); });
        // Children come after their parent.
        for (std::size_t i = moments_.size(); i-- > 0;)
            gather(i, false);
    }

    [[nodiscard]] bool may_turn(std::size_t index) const {
        if (own_axes_ == OwnAxes::never ||
            (own_axes_ == OwnAxes::where_turned && !tree_.nodes[index].frame.turned))
            return false;
        return moments_[index].end - moments_[index].first <= kMostSlots;
    }

    void fit(std::size_t index) {
        Node& node = tree_.nodes[index];
        NodeFrame own;
        std::array<Aabb, Node::kWidth> boxes;
        if (may_turn(index) && principal_frame(moments_[index], own)) {
            float area = 0, own_area = 0;
            for (std::size_t i = 0; i < Node::kWidth; ++i)
                area += node.box(i).half_area();
            for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
                const NodeRef child = node.child[i];
                const std::uint32_t first =
                    child.is_leaf() ? child.first() : moments_[child.index()].first;
                const std::uint32_t end =
                    child.is_leaf() ? first + kLanes : moments_[child.index()].end;
                boxes[i] = box_of(tree_, own, first, end);
                own_area += boxes[i].half_area();
            }
            if (own_area < area || own_axes_ == OwnAxes::where_turned) {
                set_boxes(node, own, boxes);
                return;
            }
        }
        NodeFrame shifted;
        Aabb all;
        for (std::size_t i = 0; i < Node::kWidth; ++i)
            all.merge(node.box(i));
        for (std::size_t axis = 0; axis < 3; ++axis)
            shifted.origin[axis] = 0.5F * all.lower[axis] + 0.5F * all.upper[axis];
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            boxes[i] = node.box(i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                boxes[i].lower[axis] -= shifted.origin[axis];
                boxes[i].upper[axis] -= shifted.origin[axis];
            }
        }
        set_boxes(node, shifted, boxes);
    }

    void set_boxes(Node& node, const NodeFrame& frame,
                   const std::array<Aabb, Node::kWidth>& boxes) const {
        node.frame = frame;
        node.frame.turned = true;
        for (const Aabb& box : boxes)
            node.bounds.merge(box);
        // The rounding of the positions, rotated, and that of three products and their sums.
        const float rounding = 2 * position_rounding_ + 16 * 0x1p-24F * reach_of(node.bounds);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.bounds.lower[axis] -= rounding;
            node.bounds.upper[axis] += rounding;
            // An empty box stays empty, because its bounds are infinite.
            for (std::size_t i = 0; i < Node::kWidth; ++i) {
                node.lower[axis][i] = boxes[i].lower[axis] - rounding;
                node.upper[axis][i] = boxes[i].upper[axis] + rounding;
            }
        }
        node.reach = reach_of(node.bounds);
    }

    void turn_leaves(const Node& node) {
        const NodeFrame& frame = node.frame;
        const bool is_turned = frame.turn != NodeFrame().turn;
        const Vec3 origin{frame.origin[0], frame.origin[1], frame.origin[2]};
        for (const NodeRef child : node.child) {
            if (child.is_none() || !child.is_leaf())
                continue;
            // Computed from the positions in double, so that a leaf's error is relative to its own
            // size.
            TriangleLeaf& leaf = tree_.leaves[child.first() / kLanes];
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const auto& t = mesh_.triangles[tree_.order[child.first() + lane]];
                for (std::size_t v = 0; v < 3; ++v) {
                    const Vec3& at = mesh_.positions[t[v]];
                    const Vec3 p = is_turned ? frame.point_from_tree(at) : at - origin;
                    leaf.v[v][0][lane] = to_float(p.x);
                    leaf.v[v][1][lane] = to_float(p.y);
                    leaf.v[v][2][lane] = to_float(p.z);
                }
            }
        }
    }

    Tree& tree_;
    const TreeMesh& mesh_;
    OwnAxes own_axes_;
    float position_rounding_; ///< rounding error of a position stored in single precision
    std::vector<Moments> moments_;
};

} // namespace

void fill_leaves(Tree& tree, const TreeMesh& mesh) {
    tree.leaves.resize(tree.order.size() / kLanes);
    parallel_for(tree.leaves.size(), 1024, [&](std::size_t i) {
        TriangleLeaf& leaf = tree.leaves[i];
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const auto& t = mesh.triangles[tree.order[i * kLanes + lane]];
            for (std::size_t v = 0; v < 3; ++v)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    leaf.v[v][axis][lane] =
                        to_float(component(mesh.positions[t[v]], static_cast<int>(axis)));
        }
    });
}

void orient_nodes(Tree& tree, const TreeMesh& mesh, OwnAxes own_axes) {
    if (!tree.empty())
        Orienter(tree, mesh, own_axes).run();
}

} // namespace abut
