#include "rigid/model/tree_boxes.h"

#include "rigid/model/model_data.h"

namespace abut {

namespace {

/// Sets the boxes of a node's children, and returns the box around them.
Box3 set_boxes(const ModelData& model, const Transform& tree_from_model, std::uint32_t index,
               std::vector<Box3>& boxes) {
    const Node& node = model.tree().nodes[index];
    Box3 all;
    for (std::uint32_t lane = 0; lane < Node::kWidth && !node.child[lane].is_none(); ++lane) {
        const NodeRef child = node.child[lane];
        Box3 box;
        if (!child.is_leaf())
            box = set_boxes(model, tree_from_model, child.index(), boxes);
        else
            for (std::uint32_t i = 0; i < child.count(); ++i)
                for (const Vec3& p : model.world_slot(child.first() + i, tree_from_model))
                    extend(box, p);
        boxes[child_name(index, lane)] = box;
        extend(all, box.lower), extend(all, box.upper);
    }
    return all;
}

} // namespace

const std::vector<Box3>& LazyTreeBoxes::of(const ModelData& model) const {
    std::call_once(once_, [&] {
        boxes_.resize(model.tree().nodes.size() * Node::kWidth);
        set_boxes(model, inverse(model.model_from_tree()), 0, boxes_);
    });
    return boxes_;
}

} // namespace abut
