#include "deform/feature_pairs.h"

namespace abut {

bool boxes_apart(ElementaryKind kind, const PairVertices& vertices, double margin) {
    const std::size_t of_first = kind == ElementaryKind::vertex_face ? 1 : 2;
    for (int axis = 0; axis < 3; ++axis) {
        bool below = true, above = true;
        for (const auto end : {&MovingVertex::start, &MovingVertex::end}) {
            const auto coordinate = [&](std::size_t i) {
                return component(vertices[i]->*end, axis);
            };
            double low[2] = {coordinate(0), coordinate(of_first)}, high[2] = {low[0], low[1]};
            for (std::size_t i = 1; i < 4; ++i) {
                const std::size_t side = i < of_first ? 0 : 1;
                low[side] = std::min(low[side], coordinate(i));
                high[side] = std::max(high[side], coordinate(i));
            }
            // A rounded difference is below a double only if the exact one is.
            below = below && high[0] - low[1] < -margin;
            above = above && high[1] - low[0] < -margin;
        }
        if (below || above)
            return true;
    }
    return false;
}

} // namespace abut
