#pragma once

#include <abut/camera.h>

#include "view/selection/frustum.h"
#include "view/selection/view_item.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace abut {

class OcclusionBuffer;

/// Where the eye is, in the frame of a tree of levels, and what it sees.
struct ViewPoint {
    ViewPoint() = default;
    ViewPoint(const Camera& camera, const Vec3& origin);

    /// An upper bound on the size in pixels of a ball of a small radius anywhere in the visible
    /// part of a box. That of a box is at least that of a box inside of it.
    ///
    /// In          distance: from the eye to the box of the node.
    /// Source      At the angle t from the middle of the picture, where tan(t)^2 = x^2 + y^2, a
    ///             length at a distance d from the eye covers at most 1 + x^2 + y^2 times the
    ///             pixels
    ///             that it would cover in the middle.
    [[nodiscard]] double pixels(double radius, const LevelNode& node, double distance) const {
        return radius <= 0 ? 0
                           : 2 * radius * stretch(node) * pixels_at_one / std::max(distance, near);
    }

    std::array<double, 3> eye{};
    double pixels_at_one = 1; ///< pixels of a length of 1 at distance 1 in the middle
    double near = 0;          ///< nothing nearer is visible
    Frustum frustum;

private:
    /// The largest value of 1 + x^2 + y^2 in the visible part of a box.
    [[nodiscard]] double stretch(const LevelNode& node) const;

    Vec3 right_, up_, forward_;
    double slope_x_ = 0, slope_y_ = 0;
};

struct CutLimits {
    double pixel_error = 1;
    std::uint64_t triangles = std::numeric_limits<std::uint64_t>::max();
    std::uint32_t draws = std::numeric_limits<std::uint32_t>::max();
    /// Of the chunks of the cut and of all that it replaces.
    std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
};

/// What must not be drawn.
struct NotDrawn {
    const std::vector<bool>* hidden = nullptr; ///< by part; of instances only
    const OcclusionBuffer* occlusion = nullptr;
    /// If given, whether a chunk can be drawn. Then no item is replaced by chunks that cannot.
    std::function<bool(std::uint32_t chunk)> is_there{};
};

/// An item that was visited: it is drawn, or replaced by others.
struct CutEntry {
    ViewItem item;
    std::uint32_t chunk = kNoChunk;
    float error = 0;    ///< in pixels
    float distance = 0; ///< from the eye to the box
    std::uint32_t planes = 0;
    std::uint32_t first = 0, count = 0; ///< its visible children in entries(), if it is replaced
    bool is_replaced = false;
};

/// The coarsest set of items that covers all that is visible, with errors of at most a number of
/// pixels, within limits.
///
/// The item with the largest error is replaced first. An item whose children exceed a limit stays,
/// and then those with less than half of its error, if a limit is reached but for an eighth.
/// So the result depends on the camera, the limits and the tree only.
///
/// Cost        O(n log n) of the visited items n, which are those of the cut and their ancestors.
class LevelCut {
public:
    /// Takes all the memory that it ever needs.
    explicit LevelCut(const LevelTree& tree);

    void choose(const ViewPoint& view, const CutLimits& limits, const NotDrawn& not_drawn = {});

    /// Parents come before their children, which are contiguous. The children of the larger error
    /// come first, so this is an order to load in.
    [[nodiscard]] std::span<const CutEntry> entries() const { return entries_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint32_t draws() const { return draws_; }     ///< different chunks
    [[nodiscard]] double error() const { return error_; }            ///< largest, in pixels
    [[nodiscard]] std::uint64_t outside() const { return outside_; } ///< of the frustum
    [[nodiscard]] std::uint64_t occluded() const { return occluded_; }
    [[nodiscard]] std::uint64_t bytes() const;

private:
    bool replace(std::uint32_t at);
    [[nodiscard]] bool is_there(ViewItem item) const;
    [[nodiscard]] bool is_almost_full() const;
    void visit(ViewItem item, std::uint32_t planes);
    void push(std::uint32_t at);
    void add(const CutEntry& entry);
    void subtract(const CutEntry& entry);
    void hold(const CutEntry& entry);
    void release(const CutEntry& entry);
    void forget();

    ViewItems items_;
    const ViewPoint* view_ = nullptr;
    CutLimits limits_;
    NotDrawn not_drawn_;
    std::vector<CutEntry> entries_;
    std::vector<std::uint32_t> heap_; ///< entries that could be replaced
    std::vector<std::uint32_t> uses_; ///< by chunk: entries that show it
    std::vector<std::uint32_t> held_; ///< by chunk: entries with it, the replaced ones too
    std::uint64_t triangles_ = 0, held_bytes_ = 0, outside_ = 0, occluded_ = 0;
    std::uint32_t draws_ = 0;
    double error_ = 0;
    double full_at_ = 0; ///< the error of the first item that did not fit; 0: all did
};

/// The entries that are drawn while some chunks are missing: the finest set that covers the cut
/// with chunks that are there. No entry is drawn together with one that it replaces.
class DrawnCut {
public:
    /// In          is_there(chunk): whether the chunk can be drawn.
    template <typename IsThere>
    void choose(std::span<const CutEntry> cut, const IsThere& is_there);

    [[nodiscard]] std::span<const std::uint32_t> drawn() const { return drawn_; }
    /// Returns whether something visible is not covered.
    [[nodiscard]] bool has_hole() const { return has_hole_; }

private:
    std::vector<bool> covered_; ///< by entry: it and its descendants can cover it
    std::vector<bool> reached_;
    std::vector<std::uint32_t> drawn_;
    bool has_hole_ = false;
};

template <typename IsThere>
void DrawnCut::choose(std::span<const CutEntry> cut, const IsThere& is_there) {
    drawn_.clear();
    has_hole_ = false;
    covered_.assign(cut.size(), false);
    reached_.assign(cut.size(), false);
    std::vector<bool>& covered = covered_;
    const auto children_cover = [&](const CutEntry& entry) {
        for (std::uint32_t i = 0; i < entry.count; ++i)
            if (!covered[entry.first + i])
                return false;
        return true;
    };
    // Children come after their parents: backwards, the children are known first.
    for (std::size_t i = cut.size(); i-- > 0;) {
        const CutEntry& entry = cut[i];
        covered[i] = entry.is_replaced && children_cover(entry);
        if (!covered[i])
            covered[i] = entry.chunk == kNoChunk ? !entry.is_replaced : is_there(entry.chunk);
    }
    if (!cut.empty())
        reached_[0] = true;
    for (std::size_t i = 0; i < cut.size(); ++i) {
        if (!reached_[i])
            continue;
        const CutEntry& entry = cut[i];
        const bool has_own = entry.chunk != kNoChunk && is_there(entry.chunk);
        if (entry.is_replaced && (children_cover(entry) || !has_own)) {
            for (std::uint32_t k = 0; k < entry.count; ++k)
                reached_[entry.first + k] = true;
        } else if (has_own) {
            drawn_.push_back(static_cast<std::uint32_t>(i));
        } else {
            has_hole_ = has_hole_ || entry.chunk != kNoChunk;
        }
    }
}

} // namespace abut
