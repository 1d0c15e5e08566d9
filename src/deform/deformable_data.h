#pragma once

#include <abut/deformable.h>

#include "deform/feature_boxes.h"
#include "deform/flat_regions.h"
#include "deform/leaf_features.h"
#include "deform/rest_model.h"
#include "mesh/representative_triangles.h"
#include "tree/moving_tree.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

struct FeatureTrees;

/// The hierarchy over a surface's swept triangles, and the boxes of the features in its leaves.
struct SweptTree {
    MovingTree tree;
    LeafFeatures leaves; ///< without boxes if the surface is lean: see leaf_boxes.h
};

/// The boxes at the start of a step.
enum class FirstBoxes : std::uint8_t {
    unknown,   ///< to be fitted to the positions
    last_ends, ///< those at the end of the last step
};

class DeformableData {
public:
    DeformableData();
    ~DeformableData();
    DeformableData(const DeformableData&) = delete;
    DeformableData& operator=(const DeformableData&) = delete;

    DeformableOptions options;
    std::vector<IndexTriangle> triangles;
    SurfaceFeatures features;             ///< edges_of is empty unless feature pairs are spawned
                                          ///< from triangle pairs
    std::vector<Represented> represented; ///< one for each triangle
    std::vector<MovingVertex> vertices;
    SweptTree swept;
    FlatRegions flat_regions;                    ///< of the nodes of `swept`
    std::unique_ptr<FeatureTrees> feature_trees; ///< for Scheme::features
    std::unique_ptr<FeatureBoxes> feature_boxes; ///< if `compares_boxes_of_pairs`
    RestModel rest_model;                        ///< made when it is first asked for

    [[nodiscard]] SurfaceView surface() const { return {vertices.size(), triangles, features}; }
    /// Returns whether leaves of the hierarchy are searched, not pairs of triangles or of features.
    [[nodiscard]] bool searches_leaves() const {
        return options.scheme == Scheme::representative && options.culling == Culling::tree;
    }
    /// Returns whether pairs of triangles are taken one by one, and the boxes of their features
    /// compared.
    [[nodiscard]] bool compares_boxes_of_pairs() const {
        return options.scheme == Scheme::pairwise || options.scheme == Scheme::database ||
               (options.scheme == Scheme::representative && options.culling != Culling::tree);
    }
    /// Whether no vertex moves in this step.
    [[nodiscard]] bool is_at_rest() const;

    /// Fills `features.edges_of` if it is empty.
    void find_edges_of_triangles();
    /// Builds the hierarchy from scratch.
    void build();
    /// Fits all boxes to the motion. Rebuilds the hierarchy if its boxes have become too loose.
    void refit(FirstBoxes first);

private:
    void fit_boxes(FirstBoxes first);
    [[nodiscard]] MovingBox face_box(std::uint32_t leaf, std::uint32_t k) const;
    [[nodiscard]] double looseness() const;

    double looseness_when_built_ = 0;
};

} // namespace abut
