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

} // namespace abut
