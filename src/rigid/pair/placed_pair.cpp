#include "rigid/pair/placed_pair.h"

namespace abut {

PlacedPair::PlacedPair(const Model& a, const Transform& world_from_a, const Model& b,
                       const Transform& world_from_b)
    : a_(&a.data()), b_(&b.data()), world_from_a_(world_from_a), world_from_b_(world_from_b) {
    require_finite(world_from_a, "transform of a");
    require_finite(world_from_b, "transform of b");
    compare_frames();
    if (!frame_.valid && !a_->tree().empty() && !b_->tree().empty()) {
        // The copies have the same positions, by the same formula; the identity keeps them.
        baked_a_ = baked(a, world_from_a), baked_b_ = baked(b, world_from_b);
        a_ = &baked_a_->data(), b_ = &baked_b_->data();
        world_from_a_ = world_from_b_ = {};
        compare_frames();
    }
}

void PlacedPair::compare_frames() {
    const Transform world_from_tree_a = compose(world_from_a_, a().model_from_tree()),
                    world_from_tree_b = compose(world_from_b_, b().model_from_tree());
    frame_ = make_pair_frame(a().tree(), world_from_tree_a, b().tree(), world_from_tree_b);
    if (a().volumes() != nullptr && b().volumes() != nullptr)
        volume_frame_ =
            make_volume_frame(*a().volumes(), world_from_tree_a, *b().volumes(), world_from_tree_b);
}

Volume PlacedPair::volume() const {
    const Volume common = common_volume(a().volume(), b().volume());
    return volume_frame_.valid || common == Volume::aabb ? common : Volume::automatic;
}

Verdict PlacedPair::visit_contacts(PairTraversal& t, LeafPairVisitor& visitor) const {
    return volume_frame_.valid
               ? traverse_contacts({t, *a().volumes(), *b().volumes(), volume_frame_}, visitor)
               : traverse_contacts(t, visitor);
}
Verdict PlacedPair::visit_within(PairTraversal& t, LeafPairVisitor& visitor) const {
    return volume_frame_.valid
               ? traverse_within({t, *a().volumes(), *b().volumes(), volume_frame_}, visitor)
               : traverse_within(t, visitor);
}
Verdict PlacedPair::visit_nearest(PairTraversal& t, LeafPairVisitor& visitor) const {
    return volume_frame_.valid
               ? traverse_nearest({t, *a().volumes(), *b().volumes(), volume_frame_}, visitor)
               : traverse_nearest(t, visitor);
}

} // namespace abut
