#include "rigid/tolerance/faces_in_reach.h"

#include "core/stop.h"

#include <algorithm>
#include <vector>

namespace abut {

namespace {

/// A node or a leaf of a tree, and a ball in the world that encloses its faces.
struct Ball {
    NodeRef ref;
    Vec3 middle;
    double radius;
};

Ball ball_around(const PlacedModel& model, NodeRef ref, const Aabb& box, const NodeFrame& frame) {
    const Vec3 lower{box.lower[0], box.lower[1], box.lower[2]},
        upper{box.upper[0], box.upper[1], box.upper[2]};
    // The frame's axes are perpendicular and of unit length to a few parts in 2^24.
    const double off = 0x1p-20 * (length(lower) + length(upper));
    const Vec3 middle = 0.5 * lower + 0.5 * upper;
    return {ref, apply(model.world_from_tree(), frame.point_to_tree(middle)),
            model.most_stretch() * (length(upper - middle) + off) * (1 + 0x1p-20)};
}

bool visit_faces(const WorldSolid::Block& block, const Box3& box, double around,
                 ReachSearch& search,
                 const std::function<bool(const Triangle&, std::uint32_t)>& visit) {
    const PlacedModel& model = block.model;
    const Tree& tree = model.data().tree();
    if (tree.empty())
        return true;
    std::vector<Ball> waiting{ball_around(model, NodeRef::node(0), tree.bounds, {})};
    while (!waiting.empty()) {
        const Ball ball = waiting.back();
        waiting.pop_back();
        poll_stop();
        const Vec3 reach{ball.radius, ball.radius, ball.radius};
        if (!overlap({ball.middle - reach, ball.middle + reach}, box) ||
            search.rules_out(ball.middle, ball.radius + around))
            continue;
        if (ball.ref.is_leaf()) {
            const std::uint32_t first = ball.ref.first();
            for (std::uint32_t slot = first; slot < first + ball.ref.count(); ++slot)
                if (!visit(model.world_slot(slot), block.number(model.data().triangle_at(slot))))
                    return false;
            continue;
        }
        const Node& node = tree.nodes[ball.ref.index()];
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            waiting.push_back(ball_around(model, node.child[i], node.box(i), node.frame));
    }
    return true;
}

} // namespace

void for_each_face_in_reach(const WorldSolid& surface, const Box3& box, double around,
                            ReachSearch& search,
                            const std::function<bool(const Triangle&, std::uint32_t)>& visit) {
    bool go_on = true;
    surface.for_each_surface_block(box, [&](const WorldSolid::Block& block) {
        return go_on = visit_faces(block, box, around, search, visit);
    });
}

} // namespace abut
