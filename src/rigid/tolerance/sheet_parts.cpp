#include "rigid/tolerance/sheet_parts.h"

#include "rigid/tolerance/face_cutter.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace abut {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

BoxIndex index_of_sides(const std::vector<FaceSide>& sides) {
    std::vector<Box3> boxes;
    for (const FaceSide& side : sides)
        boxes.push_back(box_of(side.line));
    return BoxIndex(std::move(boxes));
}

ReachBounds as_known(const ReachBounds& bounds) {
    return bounds;
}
/// A part without an upper bound is likely farther than all that have one.
ReachBounds as_likely(const ReachBounds& bounds) {
    ReachBounds likely = bounds;
    if (bounds.high == kUnbounded)
        likely.low = kUnbounded;
    return likely;
}

void sort_unique(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

} // namespace

ReachBounds lesser(const ReachBounds& a, const ReachBounds& b) {
    return a.high == b.high ? (a.low <= b.low ? a : b) : (a.high < b.high ? a : b);
}
ReachBounds greater(const ReachBounds& a, const ReachBounds& b) {
    ReachBounds bounds = a.low >= b.low ? a : b;
    bounds.high = std::max(a.high, b.high);
    return bounds;
}

SheetParts::SheetParts(const Sheet& own, const OtherSheet& other,
                       std::span<const SheetCrossing> crossings, double border_reach, double near,
                       ReachSearch::Options options)
    : own_(own), other_(other), near_(near), options_(std::move(options)) {
    cut(crossings, border_reach);
    sets_ = DisjointSets(pieces_.size());
    const std::vector<FaceSide> sides = open_sides();
    const BoxIndex index = index_of_sides(sides);
    connect_sides(sides, index);
    find_sides(crossings, sides, index);
    for (const auto& [curve, found] : sides_)
        for (const Sides& s : found)
            for (const auto* parts : {&s.over, &s.under})
                for (const std::uint32_t part : *parts)
                    pieces_of_[part] = {}, reach_[part] = {0, kUnbounded, {}};
    for (std::uint32_t i = 0; i < pieces_.size(); ++i)
        if (const auto at = pieces_of_.find(sets_.root(i)); at != pieces_of_.end())
            at->second.push_back(i);
}

/// Cuts all faces along their lines.
void SheetParts::cut(std::span<const SheetCrossing> crossings, double border_reach) {
    lines_.resize(own_.triangles());
    for (const SheetCrossing& c : crossings)
        lines_[c.own].push_back(c.line);
    for (std::uint32_t i = 0; i < own_.triangles(); ++i) {
        first_piece_.push_back(static_cast<std::uint32_t>(pieces_.size()));
        const Triangle& t = own_.triangle(i);
        if (own_.normal(i) == Vec3{})
            continue;
        for (const DirectedPiece& line :
             other_.border.ends_on({t, own_.normal(i), lines_[i]}, border_reach))
            lines_[i].push_back(line);
        if (lines_[i].empty())
            pieces_.push_back({i, {t[0], t[1], t[2]}});
        else
            for (auto& polygon : pieces_of_face(t, own_.normal(i), lines_[i], near_))
                pieces_.push_back({i, std::move(polygon)});
    }
    first_piece_.push_back(static_cast<std::uint32_t>(pieces_.size()));
}

/// Connects faces without lines at common edges. Returns the sides of all pieces that may be connected
/// elsewhere.
std::vector<FaceSide> SheetParts::open_sides() {
    std::vector<FaceSide> sides;
    own_.for_each_edge([&](std::span<const FaceSide> faces) {
        bool is_open = true;
        for (const FaceSide& face : faces)
            is_open = is_open && same_side(face.inward, faces[0].inward);
        for (const FaceSide& face : faces)
            is_open = is_open || !lines_[face.owner].empty();
        std::optional<std::uint32_t> before;
        for (const FaceSide& face : faces) {
            const std::uint32_t piece = first_piece_[face.owner];
            if (is_open && lines_[face.owner].empty())
                sides.push_back({face.line, face.inward, piece});
            if (!is_open)
                sets_.unite(piece, before.value_or(piece));
            before = piece;
        }
    });
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
        const auto& [face, polygon] = pieces_[i];
        if (lines_[face].empty())
            continue;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const LinePiece line{polygon[k], polygon[(k + 1) % polygon.size()]};
            sides.push_back({line, left_of(line, own_.normal(face)), i});
        }
    }
    return sides;
}

/// Connects pieces whose sides share more than `near` where no line runs.
void SheetParts::connect_sides(const std::vector<FaceSide>& sides, const BoxIndex& index) {
    std::vector<LinePiece> lines;
    std::vector<Box3> boxes;
    for (const auto& of_face : lines_)
        for (const DirectedPiece& line : of_face)
            lines.push_back(line.piece), boxes.push_back(box_of(line.piece));
    const BoxIndex index_of_lines(std::move(boxes));
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
        const LinePiece& line = sides[i].line;
        const Vec3 along = normalized_or_zero(line.q - line.p);
        index.for_each_overlap(grown(box_of(line), near_), [&](std::uint32_t j) {
            const std::uint32_t p = sides[i].owner, q = sides[j].owner;
            if (j <= i || sets_.root(p) == sets_.root(q))
                return;
            const auto span = common_span(line, sides[j].line, near_, 2 * near_);
            if (!span)
                return;
            const LinePiece common{line.p + span->from * along, line.p + span->to * along};
            std::vector<LineSpan> covers;
            // A line that is near a side is within this of all sides that are near that one.
            const double near = 3 * near_;
            index_of_lines.for_each_overlap(grown(box_of(common), near), [&](std::uint32_t k) {
                if (const auto cover = common_span(common, lines[k], near, 0))
                    covers.push_back({cover->from - near_, cover->to + near_});
            });
            if (!uncovered({0, span->to - span->from}, covers, near_).empty())
                sets_.unite(p, q);
        });
    }
}

/// Returns whether the piece at a side is thicker than `near` at a point close to the side. If not, and it
/// narrows there, its other sides are as close.
bool SheetParts::goes_on(const FaceSide& side, const Vec3& point) const {
    const auto& [face, polygon] = pieces_[side.owner];
    const Vec3 inside = point + 1.5 * near_ * side.inward;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const LinePiece line{polygon[k], polygon[(k + 1) % polygon.size()]};
        if (dot(inside - line.p, left_of(line, own_.normal(face))) < 0)
            return false;
    }
    return true;
}

/// Finds the parts on both sides of each crossing.
void SheetParts::find_sides(std::span<const SheetCrossing> crossings,
                            const std::vector<FaceSide>& sides, const BoxIndex& index) {
    struct Neighbour {
        LineSpan span;
        std::uint32_t side;
        bool is_over;
    };
    for (const SheetCrossing& c : crossings) {
        const LinePiece& line = c.line.piece;
        const Vec3 along = normalized_or_zero(line.q - line.p);
        Vec3 upward = other_.sheet.normal(c.other);
        std::vector<Neighbour> neighbours;
        std::vector<double> ends;
        index.for_each_overlap(grown(box_of(line), near_), [&](std::uint32_t i) {
            if (const auto span = common_span(line, sides[i].line, near_, 2 * near_)) {
                if (upward == Vec3{}) // the other face is thin
                    upward = sides[i].inward;
                neighbours.push_back({*span, i, dot(sides[i].inward, upward) > 0});
                ends.push_back(span->from);
                ends.push_back(span->to);
            }
        });
        std::sort(ends.begin(), ends.end());
        for (std::size_t i = 1; i < ends.size(); ++i) {
            if (ends[i] - ends[i - 1] <= 2 * near_)
                continue;
            const double at = 0.5 * (ends[i] + ends[i - 1]);
            Sides found;
            const Vec3 middle = line.p + at * along;
            for (const Neighbour& n : neighbours)
                if (n.span.from < at && at < n.span.to && goes_on(sides[n.side], middle))
                    (n.is_over ? found.over : found.under)
                        .push_back(sets_.root(sides[n.side].owner));
            sort_unique(found.over);
            sort_unique(found.under);
            if (!found.over.empty() && !found.under.empty())
                sides_[c.curve].push_back(std::move(found));
        }
    }
    for (auto& [curve, found] : sides_) {
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }
}

Proof SheetParts::ends_within(std::uint32_t curve, double limit) {
    Proof all = Proof::holds;
    for (const auto& [over, under] : sides_[curve]) {
        const Proof first = is_within(over, limit);
        all = both_hold(all, first == Proof::holds ? first
                                                   : either_holds(first, is_within(under, limit)));
    }
    return all;
}

Proof SheetParts::is_within(const std::vector<std::uint32_t>& parts, double limit) {
    Proof all = Proof::holds;
    for (const std::uint32_t part : parts)
        all = both_hold(all, examine(part, limit));
    return all;
}

/// Decides whether a part is within a limit, unless that is known.
Proof SheetParts::examine(std::uint32_t part, double limit) {
    ReachBounds& known = reach_[part];
    if (known.high <= limit || known.low > limit)
        return known.high <= limit ? Proof::holds : Proof::fails;
    ReachSearch::Options options = options_;
    options.limit = limit;
    ReachSearch search(other_.surface, options);
    for (const std::uint32_t i : pieces_of_[part]) {
        const std::vector<Vec3>& polygon = pieces_[i].polygon;
        for (std::size_t k = 2; k < polygon.size() && search.proof() == Proof::holds; ++k)
            search.add({polygon[0], polygon[k - 1], polygon[k]});
    }
    if (search.proof() == Proof::holds)
        known.high = limit;
    if (search.proof() != Proof::fails)
        return search.proof();
    const double distance =
        other_.surface.nearest(search.counterexample(), WorldSolid::NearestSearch{}).distance;
    if (distance > known.low)
        known.low = distance, known.point = search.counterexample();
    return Proof::fails;
}

ReachBounds SheetParts::reach_of(std::uint32_t curve, Choose choose) const {
    ReachBounds most;
    const auto at = sides_.find(curve);
    if (at == sides_.end())
        return most;
    const auto of_parts = [&](const std::vector<std::uint32_t>& parts) {
        ReachBounds bounds;
        for (const std::uint32_t part : parts)
            bounds = greater(bounds, choose(reach_.at(part)));
        return bounds;
    };
    for (const auto& [over, under] : at->second)
        most = greater(most, lesser(of_parts(over), of_parts(under)));
    return most;
}

ReachBounds SheetParts::reach_beyond(std::uint32_t curve) const {
    return reach_of(curve, as_known);
}
ReachBounds SheetParts::likely_reach(std::uint32_t curve) const {
    return reach_of(curve, as_likely);
}

void SheetParts::look_at_corners() {
    for (auto& [part, bounds] : reach_) {
        if (bounds.high == kUnbounded || !looked_at_.insert(part).second)
            continue;
        for (const std::uint32_t i : pieces_of_[part])
            for (const Vec3& corner : pieces_[i].polygon)
                if (const double distance =
                        other_.surface.nearest(corner, WorldSolid::NearestSearch{}).distance;
                    distance > bounds.low)
                    bounds.low = distance, bounds.point = corner;
    }
}

} // namespace abut
