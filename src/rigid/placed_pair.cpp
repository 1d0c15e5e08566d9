#include "rigid/placed_pair.h"

namespace abut {

namespace {

Model baked(const Model& model, const Transform& world) {
    Mesh mesh = model.mesh();
    for (Vec3& p : mesh.positions)
        p = apply(world, p);
    return Model(std::move(mesh));
}

PairFrame frame_of(const Model& a, const Transform& world_from_a, const Model& b,
                   const Transform& world_from_b) {
    return make_pair_frame(a.data().tree(), compose(world_from_a, a.data().model_from_tree()),
                           b.data().tree(), compose(world_from_b, b.data().model_from_tree()));
}

} // namespace

PlacedPair::PlacedPair(const Model& a, const Transform& world_from_a, const Model& b,
                       const Transform& world_from_b)
    : a_(a), b_(b), world_from_a_(world_from_a), world_from_b_(world_from_b) {
    require_finite(world_from_a, "transform of a");
    require_finite(world_from_b, "transform of b");
    frame_ = frame_of(a_, world_from_a_, b_, world_from_b_);
    if (!frame_.valid && !a_.data().tree().empty() && !b_.data().tree().empty()) {
        // The same positions by the same formula; identity then leaves them as they are.
        a_ = baked(a, world_from_a), b_ = baked(b, world_from_b);
        world_from_a_ = world_from_b_ = {};
        frame_ = frame_of(a_, world_from_a_, b_, world_from_b_);
    }
}

void LeafTriangles::fetch(NodeRef leaf_a, NodeRef leaf_b) {
    if (leaf_a.first() != first_a_) {
        first_a_ = leaf_a.first(), count_a_ = leaf_a.count();
        for (std::uint32_t i = 0; i < count_a_; ++i)
            a_[i] = pair_.a().world_triangle(first_a_ + i, pair_.world_from_a());
    }
    if (leaf_b.first() != first_b_) {
        first_b_ = leaf_b.first(), count_b_ = leaf_b.count();
        for (std::uint32_t lane = 0; lane < TriangleBlock::kLanes; ++lane)
            b_.set(lane, lane < count_b_
                             ? pair_.b().world_triangle(first_b_ + lane, pair_.world_from_b())
                             : b_.get(0));
    }
}

} // namespace abut
