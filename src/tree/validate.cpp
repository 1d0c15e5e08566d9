#include "math/vector.h"
#include "tree/obb_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abut {

namespace {

/// Walks the tree and checks with `encloses` that each box encloses every primitive below it.
template <typename Encloses>
class Validator {
public:
    Validator(const Tree& tree, std::size_t primitives, const Encloses& encloses)
        : tree_(tree), seen_(primitives), encloses_(encloses) {
        if (tree.empty() != (primitives == 0))
            throw std::logic_error("tree: wrong number of primitives");
        if (tree.empty())
            return;
        below(NodeRef::node(0));
        if (std::find(seen_.begin(), seen_.end(), 0) != seen_.end())
            throw std::logic_error("tree: a primitive is in no leaf");
    }

private:
    std::vector<std::uint32_t> below(NodeRef ref) {
        std::vector<std::uint32_t> primitives;
        if (ref.is_leaf()) {
            for (std::uint32_t slot = ref.first(); slot < ref.first() + ref.count(); ++slot) {
                const std::uint32_t primitive = tree_.order.at(slot);
                if (seen_.at(primitive)++ != 0)
                    throw std::logic_error("tree: a primitive is in two leaves");
                primitives.push_back(primitive);
            }
            return primitives;
        }
        const Node& node = tree_.nodes.at(ref.index());
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            if (node.child[i].is_none())
                continue;
            for (const std::uint32_t primitive : below(node.child[i])) {
                if (!encloses_(node, node.box(i), primitive) ||
                    !encloses_(node, node.bounds, primitive))
                    throw std::logic_error("tree: a box does not enclose what is below it");
                primitives.push_back(primitive);
            }
        }
        return primitives;
    }

    const Tree& tree_;
    std::vector<std::uint8_t> seen_;
    const Encloses& encloses_;
};

} // namespace

void validate(const Tree& tree, std::span<const Aabb> boxes) {
    const auto encloses = [&](const Node&, const Aabb& box, std::uint32_t primitive) {
        const Aabb& inner = boxes[primitive];
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (inner.lower[axis] < box.lower[axis] || inner.upper[axis] > box.upper[axis])
                return false;
        return true;
    };
    Validator(tree, boxes.size(), encloses);
}

void validate(const Tree& tree, const TreeMesh& mesh) {
    const auto encloses = [&](const Node& node, const Aabb& box, std::uint32_t triangle) {
        for (const std::uint32_t v : mesh.triangles[triangle]) {
            const Vec3 p = node.frame.point_from_tree(mesh.positions[v]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = component(p, static_cast<int>(axis));
                if (x < double{box.lower[axis]} || x > double{box.upper[axis]} ||
                    std::abs(x) > double{node.reach})
                    return false;
            }
        }
        return true;
    };
    Validator(tree, mesh.triangles.size(), encloses);
}

} // namespace abut
