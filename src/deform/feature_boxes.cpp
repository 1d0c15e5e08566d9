#include "deform/feature_boxes.h"

#include "core/parallel.h"

#include <utility>

namespace abut {

namespace {

/// Features whose boxes a thread computes at once.
constexpr std::size_t kFeaturesAtOnce = 4096;

template <std::size_t n>
std::vector<MovingBox> moving_boxes_of(std::span<const std::array<std::uint32_t, n>> features,
                                       const std::vector<MovingBox>& vertices) {
    std::vector<MovingBox> boxes(features.size());
    parallel_for(features.size(), kFeaturesAtOnce, [&](std::size_t i) {
        for (const std::uint32_t v : features[i]) {
            if (v == kNoEdge)
                return;
            boxes[i].start.merge(vertices[v].start);
            boxes[i].end.merge(vertices[v].end);
        }
    });
    return boxes;
}

} // namespace

FeatureBoxes::FeatureBoxes(std::vector<MovingBox> vertex_boxes,
                           std::span<const std::array<std::uint32_t, 2>> edge_ends,
                           std::span<const IndexTriangle> triangles)
    : vertices(std::move(vertex_boxes)), edges(moving_boxes_of<2>(edge_ends, vertices)),
      faces(moving_boxes_of<3>(triangles, vertices)) {}

} // namespace abut
