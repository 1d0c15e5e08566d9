#include "world/solids/polygon_overlap.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut {

namespace {

/// A corner of b's face while it is clipped, and the side from it to the next: an edge of b's face,
/// or of a's with kSideOfA added. All members are set when a corner is added.
struct OutlineCorner {
    double x, y, height;
    double left; ///< of the edge that clips now: see left_of
    std::uint32_t side;
};
constexpr std::uint32_t kSideOfA = 1U << 31;
using Outline = std::span<OutlineCorner>;

/// Sets `left` of all corners for the edge from p to q. Returns whether none is to the right of it.
bool lies_left(Outline outline, const FlatCorner& p, const FlatCorner& q) {
    double least = 0;
    for (OutlineCorner& corner : outline) {
        corner.left = left_of(p, q, corner.x, corner.y);
        least = std::min(least, corner.left);
    }
    return least >= 0;
}

/// Writes the part of an outline where `left` is not negative. New sides are called `side`. Returns the
/// number of its corners: at most one more than the outline has.
std::size_t keep_left(Outline outline, std::uint32_t side, OutlineCorner* kept) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const OutlineCorner &from = outline[i], &to = outline[i + 1 == outline.size() ? 0 : i + 1];
        const double here = from.left, next = to.left;
        if (here >= 0)
            kept[count++] = from;
        if ((here >= 0) == (next >= 0))
            continue;
        const double t = here / (here - next);
        kept[count++] = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                         from.height + t * (to.height - from.height), 0,
                         here >= 0 ? side : from.side};
    }
    return count;
}

/// Whether side i of a face with n corners follows side k.
bool follows(std::uint32_t i, std::uint32_t k, std::size_t n) {
    return i == (k + 1 == n ? 0 : k + 1);
}

/// Names the corners of an outline.
class CornerNames {
    using Face = std::span<const FlatCorner>;

public:
    CornerNames(const Face& a, const Face& b, std::span<const OutlineCorner> outline)
        : a_(a), b_(b), outline_(outline) {
        double low_x = outline[0].x, low_y = outline[0].y, high_x = low_x, high_y = low_y;
        for (const OutlineCorner& corner : outline) {
            low_x = std::min(low_x, corner.x), high_x = std::max(high_x, corner.x);
            low_y = std::min(low_y, corner.y), high_y = std::max(high_y, corner.y);
        }
        reach_sq_ = name_reach_sq(low_x, low_y, high_x, high_y);
    }

    [[nodiscard]] std::uint64_t name(std::size_t i) const {
        const OutlineCorner& corner = outline_[i];
        const std::uint32_t last_side = outline_[i == 0 ? outline_.size() - 1 : i - 1].side;
        const bool of_a = (corner.side & kSideOfA) != 0, last_of_a = (last_side & kSideOfA) != 0;
        const FeatureKind crossing = of_a != last_of_a ? FeatureKind::edges
                                     : of_a            ? FeatureKind::vertex_of_a
                                                       : FeatureKind::vertex_of_b;
        // The outline runs around b's face as its corners do, and against those of a. So between two sides
        // of one face that follow each other is a corner of it.
        const std::uint32_t now = corner.side & ~kSideOfA, before = last_side & ~kSideOfA;
        const NearestCorner near_a =
            crossing == FeatureKind::vertex_of_a && follows(before, now, a_.size())
                ? NearestCorner(a_[before])
                : NearestCorner(a_, corner.x, corner.y);
        const NearestCorner near_b =
            crossing == FeatureKind::vertex_of_b && follows(now, before, b_.size())
                ? NearestCorner(b_[now])
                : NearestCorner(b_, corner.x, corner.y);
        const FeatureKind kind = kind_within(reach_sq_, near_a, near_b, crossing);
        if (kind != FeatureKind::edges)
            return name_of(kind, near_a, near_b, 0, 0);
        return feature_name(kind, a_[of_a ? now : before].edge, b_[of_a ? before : now].edge);
    }

private:
    Face a_, b_;
    std::span<const OutlineCorner> outline_;
    double reach_sq_;
};

} // namespace

void add_polygon_overlap(std::span<const FlatCorner> a, std::span<const FlatCorner> b,
                         const FacePlane& plane, ContactCandidates& candidates) {
    // Each edge of a adds one corner at most. The outline moves from one half to the other and back.
    const std::size_t most = a.size() + b.size();
    boost::container::small_vector<OutlineCorner, 32> memory(2 * most,
                                                             boost::container::default_init);
    OutlineCorner *now = memory.data(), *next = now + most;
    std::size_t count = b.size();
    for (std::size_t i = 0; i < count; ++i)
        now[i] = {b[i].x, b[i].y, b[i].height, 0, static_cast<std::uint32_t>(i)};
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (lies_left({now, count}, a[i], a[i + 1 == a.size() ? 0 : i + 1]))
            continue;
        count = keep_left({now, count}, kSideOfA | static_cast<std::uint32_t>(i), next);
        if (count == 0)
            return;
        std::swap(now, next);
    }
    const std::span<const OutlineCorner> outline(now, count);
    const CornerNames names(a, b, outline);
    for (std::size_t i = 0; i < count; ++i) {
        const OutlineCorner& corner = outline[i];
        add_candidate(candidates, {corner.x, corner.y, plane.at(corner.x, corner.y), corner.height,
                                   names.name(i)});
    }
}

} // namespace abut
