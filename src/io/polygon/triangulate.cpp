#include "io/polygon/triangulate.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kNoCorner = 0xffffffff;

struct Point {
    double x = 0, y = 0;
    bool operator==(const Point&) const = default;
};

/// Twice the signed area. Its sign is exact for points that were floats of similar magnitude.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A counter-clockwise triangle, for tests of points and boxes against it.
struct Ear {
    std::array<Point, 3> corner;
    Point low, high; ///< its box

    explicit Ear(const std::array<Point, 3>& corners)
        : corner(corners), low{std::min({corner[0].x, corner[1].x, corner[2].x}),
                               std::min({corner[0].y, corner[1].y, corner[2].y})},
          high{std::max({corner[0].x, corner[1].x, corner[2].x}),
               std::max({corner[0].y, corner[1].y, corner[2].y})} {}

    /// Positive on the inner side of edge i, which begins at corner i; 0 on its line.
    [[nodiscard]] double side(std::size_t i, const Point& p) const {
        return turn(corner[i], corner[i == 2 ? 0 : i + 1], p);
    }
    /// Returns whether a box lies wholly on the outer side of an edge, or outside the triangle's
    /// own box. A thin triangle needs the second test: its edges lie almost on one long line.
    [[nodiscard]] bool misses(const Point& box_low, const Point& box_high) const {
        if (high.x < box_low.x || low.x > box_high.x || high.y < box_low.y || low.y > box_high.y)
            return true;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point& a = corner[i];
            const Point& b = corner[i == 2 ? 0 : i + 1];
            // The corner of the box that lies farthest towards the inner side.
            const Point far{b.y > a.y ? box_low.x : box_high.x, b.x > a.x ? box_high.y : box_low.y};
            if (turn(a, b, far) < 0)
                return true;
        }
        return false;
    }
};

/// The remaining corners, in a k-d tree over their positions.
class CornerTree {
public:
    explicit CornerTree(const std::vector<Point>& points) : corners_(points.size()) {
        for (std::size_t i = 0; i < points.size(); ++i)
            corners_[i] = {points[i], static_cast<std::uint32_t>(i)};
        nodes_.reserve(2 * points.size() / kLeafCorners + 2);
        leaf_of_.resize(points.size());
        build(0, static_cast<std::uint32_t>(points.size()), kNoCorner);
    }

    /// Removes a corner. The boxes around it shrink to the corners that remain.
    void remove(std::uint32_t corner) {
        std::uint32_t at = leaf_of_[corner];
        Node& leaf = nodes_[at];
        Corner* const begin = &corners_[leaf.begin];
        Corner* const end = std::remove_if(begin, begin + leaf.left,
                                           [&](const Corner& c) { return c.number == corner; });
        leaf.left = static_cast<std::uint32_t>(end - begin);
        bool shrinks = set_box(leaf, begin, end);
        while ((at = nodes_[at].parent) != kNoCorner) {
            --nodes_[at].left;
            shrinks = shrinks && enclose_children(at);
        }
    }

    /// Returns the first corner in or on the ear for which `blocks` is true; kNoCorner if none is.
    template <typename Blocks>
    std::uint32_t find(const Ear& ear, std::uint64_t& visits, const Blocks& blocks) const {
        std::array<std::uint32_t, 64> open{};
        std::size_t count = 0;
        open.at(count++) = 0;
        while (count > 0) {
            const Node& node = nodes_[open.at(--count)];
            ++visits;
            if (node.left == 0 || ear.misses(node.low, node.high))
                continue;
            if (node.second != kNoCorner) {
                open.at(count++) = node.second;
                open.at(count++) = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
                continue;
            }
            visits += node.left;
            for (std::uint32_t i = 0; i < node.left; ++i) {
                const Corner& corner = corners_[node.begin + i];
                if (blocks(corner.number, corner.point))
                    return corner.number;
            }
        }
        return kNoCorner;
    }

private:
    static constexpr std::uint32_t kLeafCorners = 8;

    struct Corner {
        Point point;
        std::uint32_t number = 0;
    };

    struct Node {
        Point low, high;         ///< box of the corners that are left
        std::uint32_t begin = 0; ///< of a leaf: its corners are the first `left` from here
        std::uint32_t left = 0;  ///< number of corners not yet removed
        std::uint32_t parent = kNoCorner;
        std::uint32_t second =
            kNoCorner; ///< second child; the first one is the next node. kNoCorner: a leaf
    };

    /// All three return whether the box has changed.
    static bool replace_box(Node& node, const Point& low, const Point& high) {
        const bool changes = !(low == node.low && high == node.high);
        node.low = low;
        node.high = high;
        return changes;
    }
    static bool set_box(Node& node, const Corner* begin, const Corner* end) {
        Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (const Corner* c = begin; c != end; ++c) {
            low = {std::min(low.x, c->point.x), std::min(low.y, c->point.y)};
            high = {std::max(high.x, c->point.x), std::max(high.y, c->point.y)};
        }
        return replace_box(node, low, high);
    }
    bool enclose_children(std::uint32_t at) {
        const Node &a = nodes_[at + 1], &b = nodes_[nodes_[at].second];
        const Point low{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)};
        const Point high{std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)};
        return replace_box(nodes_[at], low, high);
    }

    void build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent) {
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        Node node;
        node.begin = begin;
        node.left = end - begin;
        node.parent = parent;
        set_box(node, corners_.data() + begin, corners_.data() + end);
        nodes_.push_back(node);
        if (end - begin <= kLeafCorners) {
            for (std::uint32_t i = begin; i < end; ++i)
                leaf_of_[corners_[i].number] = number;
            return;
        }
        const bool wide = node.high.x - node.low.x >= node.high.y - node.low.y;
        const std::uint32_t middle = begin + (end - begin) / 2;
        // Equal coordinates keep the polygon's order, so that halves stay neighbours along it.
        std::nth_element(corners_.begin() + begin, corners_.begin() + middle,
                         corners_.begin() + end, [&](const Corner& a, const Corner& b) {
                             const double p = wide ? a.point.x : a.point.y;
                             const double q = wide ? b.point.x : b.point.y;
                             return p < q || (p == q && a.number < b.number);
                         });
        build(begin, middle, number);
        nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
        build(middle, end, number);
    }

    std::vector<Corner> corners_;
    std::vector<std::uint32_t> leaf_of_;
    std::vector<Node> nodes_;
};

class EarClipper {
public:
    EarClipper(std::span<const PlaneCorner> corners,
               std::vector<std::array<std::uint32_t, 3>>& triangles, TriangulationWork& work)
        : corners_(corners), triangles_(triangles), work_(work), points_(points_of(corners)),
          tree_(points_), links_(corners.size()) {
        const auto count = static_cast<std::uint32_t>(corners.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            links_[i].before = i == 0 ? count - 1 : i - 1;
            links_[i].after = i + 1 == count ? 0 : i + 1;
        }
        for (std::uint32_t i = 0; i < count; ++i)
            offer(i);
    }

    void run() {
        for (std::size_t left = corners_.size(); left > 3;) {
            const Candidate best = candidates_.top();
            candidates_.pop();
            const Link& link = links_[best.corner];
            if (link.is_cut || link.version != best.version)
                continue;
            if (best.rank == Rank::untested) {
                bool touches = false;
                const std::uint32_t blocker = blocker_of(best.corner, touches);
                if (blocker != kNoCorner) {
                    std::uint32_t& first =
                        touches ? links_[blocker].first_touched : links_[blocker].first_waiting;
                    waiting_.push_back({best.corner, best.version, first});
                    first = static_cast<std::uint32_t>(waiting_.size() - 1);
                    candidates_.push({Rank::blocked, best.length, best.corner, best.version});
                    continue;
                }
            }
            cut(best.corner);
            --left;
        }
        const auto last = std::find_if(links_.begin(), links_.end(),
                                       [](const Link& link) { return !link.is_cut; });
        emit(static_cast<std::uint32_t>(last - links_.begin()));
    }

private:
    /// The order in which candidates are cut. A flat ear loses no area, but an ear with an area is
    /// preferred. Blocked and turned ears are cut only where the polygon crosses itself.
    enum class Rank : std::uint8_t { untested, flat, blocked, turned };

    struct Link {
        std::uint32_t before = 0, after = 0;
        std::uint32_t version = 0; ///< candidates with another version are out of date
        bool is_cut = false;
        /// Lists in waiting_: candidates that this corner blocks from inside, and by touching.
        std::uint32_t first_waiting = kNoCorner, first_touched = kNoCorner;
    };

    struct Waiting {
        std::uint32_t corner = 0, version = 0, next = kNoCorner;
    };

    struct Candidate {
        Rank rank = Rank::untested;
        double length = 0; ///< of the diagonal, squared
        std::uint32_t corner = 0, version = 0;
        bool operator<(const Candidate& other) const { // a queue's top is its greatest element
            return std::tie(other.rank, other.length, other.corner) <
                   std::tie(rank, length, corner);
        }
    };

    static std::vector<Point> points_of(std::span<const PlaneCorner> corners) {
        std::vector<Point> points;
        points.reserve(corners.size());
        for (const PlaneCorner& corner : corners)
            points.push_back({corner.x, corner.y});
        return points;
    }

    [[nodiscard]] Ear ear_of(std::uint32_t tip) const {
        return Ear({points_[links_[tip].before], points_[tip], points_[links_[tip].after]});
    }

    void offer(std::uint32_t tip) {
        const Ear ear = ear_of(tip);
        const auto& [a, b, c] = ear.corner;
        const double area = turn(a, b, c);
        const double dx = c.x - a.x, dy = c.y - a.y;
        // A corner where the outline turns back on itself, or repeats, can be removed at once.
        // Otherwise an ear could be cut off that the outline covers once in each direction.
        const bool turns_back =
            area == 0 && (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y) >= 0;
        const Rank rank = turns_back || area > 0 ? Rank::untested
                          : area == 0            ? Rank::flat
                                                 : Rank::turned;
        candidates_.push({rank, turns_back ? 0 : dx * dx + dy * dy, tip, links_[tip].version});
    }

    /// Returns a corner that prevents an ear from being cut; kNoCorner if there is none.
    ///
    /// A corner inside the ear does. A corner on the ear's boundary, even at one of its corners,
    /// does if an edge leads from it into the ear's interior; otherwise the polygon only touches
    /// the ear there.
    ///
    /// Out         touches: whether the corner lies on the ear's boundary.
    std::uint32_t blocker_of(std::uint32_t tip, bool& touches) {
        ++work_.tests;
        const Ear ear = ear_of(tip);
        if (!(turn(ear.corner[0], ear.corner[1], ear.corner[2]) > 0))
            return kNoCorner;
        const Link& own = links_[tip];
        return tree_.find(ear, work_.visits, [&](std::uint32_t other, const Point& point) {
            std::array<bool, 3> on_line{};
            for (std::size_t i = 0; i < 3; ++i) {
                const double side = ear.side(i, point);
                if (side < 0)
                    return false;
                on_line.at(i) = side == 0;
            }
            if (other == tip || other == own.before || other == own.after)
                return false;
            const Link& link = links_[other];
            const auto leads_inside = [&](std::uint32_t neighbour) {
                for (std::size_t i = 0; i < 3; ++i)
                    if (on_line.at(i) && !(ear.side(i, points_[neighbour]) > 0))
                        return false;
                return true;
            };
            touches = on_line[0] || on_line[1] || on_line[2];
            return leads_inside(link.before) || leads_inside(link.after);
        });
    }

    void emit(std::uint32_t tip) {
        triangles_.push_back({corners_[links_[tip].before].vertex, corners_[tip].vertex,
                              corners_[links_[tip].after].vertex});
    }

    void cut(std::uint32_t tip) {
        emit(tip);
        Link& link = links_[tip];
        link.is_cut = true;
        tree_.remove(tip);
        links_[link.before].after = link.after;
        links_[link.after].before = link.before;
        release(link.first_waiting);
        for (const std::uint32_t corner : {tip, link.before, link.after})
            release(links_[corner].first_touched); // its edges have changed
        for (const std::uint32_t corner : {link.before, link.after}) {
            ++links_[corner].version;
            offer(corner);
        }
    }

    /// Tests the candidates of a list again, because they may be free now.
    void release(std::uint32_t& first) {
        for (std::uint32_t entry = std::exchange(first, kNoCorner); entry != kNoCorner;) {
            const Waiting waiting = waiting_[entry];
            Link& link = links_[waiting.corner];
            if (!link.is_cut && link.version == waiting.version) {
                ++link.version;
                offer(waiting.corner);
            }
            entry = waiting.next;
        }
    }

    std::span<const PlaneCorner> corners_;
    std::vector<std::array<std::uint32_t, 3>>& triangles_;
    TriangulationWork& work_;
    std::vector<Point> points_;
    CornerTree tree_;
    std::vector<Link> links_;
    std::vector<Waiting> waiting_;
    std::priority_queue<Candidate> candidates_;
};

/// Cuts a quadrilateral along the diagonal that lies inside it; if both do, along the one from its
/// first corner. False if no diagonal lies strictly inside.
bool cut_quadrilateral(std::span<const PlaneCorner> q,
                       std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::size_t i = 0; i < 2; ++i) {
        const PlaneCorner &a = q[i], &b = q[i + 1], &c = q[i + 2], &d = q[(i + 3) % 4];
        const Point pa{a.x, a.y}, pc{c.x, c.y};
        if (turn(pa, {b.x, b.y}, pc) > 0 && turn(pa, pc, {d.x, d.y}) > 0) {
            triangles.push_back({a.vertex, b.vertex, c.vertex});
            triangles.push_back({a.vertex, c.vertex, d.vertex});
            return true;
        }
    }
    return false;
}

} // namespace

void triangulate_in_plane(std::span<const PlaneCorner> corners,
                          std::vector<std::array<std::uint32_t, 3>>& triangles,
                          TriangulationWork* work) {
    if (corners.size() == 4 && cut_quadrilateral(corners, triangles))
        return;
    TriangulationWork unused;
    EarClipper(corners, triangles, work == nullptr ? unused : *work).run();
}

} // namespace abut
