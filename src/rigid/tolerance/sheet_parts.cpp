#include "rigid/tolerance/sheet_parts.h"

#include "core/stop.h"
#include "rigid/tolerance/face_cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace abut {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The largest distance of a polygon's point from a triangle: that of a corner, because the distance from
/// a convex set is convex.
double reach_from(const std::vector<Vec3>& polygon, const PreparedTriangle& triangle) {
    double reach_sq = 0;
    for (const Vec3& corner : polygon)
        reach_sq = std::max(reach_sq, triangle.nearest(corner).distance_sq);
    return std::sqrt(reach_sq);
}

void sort_unique(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<Box3> boxes_of_crossings(std::span<const SheetCrossing> crossings) {
    std::vector<Box3> boxes;
    for (const SheetCrossing& c : crossings)
        boxes.push_back(box_of(c.line.piece));
    return boxes;
}

constexpr std::uint32_t kNone = 0xffffffff;

} // namespace

SheetParts::SheetParts(const Sheet& own, const OtherSheet& other,
                       std::span<const SheetCrossing> crossings, double near,
                       ReachSearch::Options options)
    : own_(own), other_(other), near_(near), options_(std::move(options)), crossings_(crossings),
      index_(boxes_of_crossings(crossings)), faces_(own.triangles()) {
    for (const SheetCrossing& c : crossings)
        faces_[c.own].lines.push_back(c.line);
    for (std::uint32_t i = 0; i < crossings.size(); ++i)
        if (crossings[i].curve != SheetCrossing::kNoCurve)
            curves_[crossings[i].curve].crossings.push_back(i);
}

/// Cuts a face along its lines, unless that is done.
const SheetParts::Face& SheetParts::cut(std::uint32_t number) {
    Face& face = faces_[number];
    const Vec3& normal = own_.normal(number);
    if (face.is_cut)
        return face;
    face.is_cut = true;
    face.first = static_cast<std::uint32_t>(pieces_.size());
    const Triangle& t = own_.triangle(number);
    if (normal != Vec3{}) {
        for (const DirectedPiece& line : other_.border.ends_on({t, normal, face.lines}))
            face.lines.push_back(line);
        if (face.lines.empty())
            add_piece(number, {t[0], t[1], t[2]});
        else
            for (auto& polygon : pieces_of_face(t, normal, face.lines, near_))
                add_piece(number, std::move(polygon));
    }
    face.last = static_cast<std::uint32_t>(pieces_.size());
    return face;
}

void SheetParts::add_piece(std::uint32_t face, std::vector<Vec3> polygon) {
    const auto piece = static_cast<std::uint32_t>(pieces_.size());
    std::vector<FaceSide> sides;
    Box3 box;
    for (const Vec3& corner : polygon)
        extend(box, corner);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const LinePiece line{polygon[k], polygon[(k + 1) % polygon.size()]};
        sides.push_back({line, left_of(line, own_.normal(face)), piece});
    }
    pieces_.push_back({face, std::move(polygon), box, kNone, 0, std::move(sides)});
}

/// Calls visit(face) for a face, for those that share an edge with it, and for those with a loose edge in
/// a box.
template <typename Visit>
void SheetParts::for_each_face_at(std::uint32_t face, const Box3& box, const Visit& visit) {
    visit(face);
    for (const std::uint32_t neighbour : own_.neighbours(face))
        visit(neighbour);
    own_.for_each_loose(box, [&](std::uint32_t i) { visit(own_.loose_sides()[i].owner); });
}

/// The parts of a line near a face that lines of the face or of faces around it cover.
std::vector<LineSpan> SheetParts::covers_of(const LinePiece& common, std::uint32_t number) {
    // A line that is near a side is within this of all sides that are near that one.
    const double near = 3 * near_;
    const Box3 box = grown(box_of(common), near);
    const Vec3 along = normalized_or_zero(common.q - common.p);
    std::vector<LineSpan> covers;
    const auto add = [&](const LinePiece& line) {
        if (overlap(box, box_of(line)))
            if (const auto cover = near_span(common, along, line, near))
                covers.push_back({cover->from - near_, cover->to + near_});
    };
    index_.for_each_overlap(box, [&](std::uint32_t i) { add(crossings_[i].line.piece); });
    const auto add_ends = [&](std::uint32_t face) {
        for (const DirectedPiece& line : cut(face).lines)
            add(line.piece);
    };
    add_ends(number);
    for (const std::uint32_t neighbour : own_.neighbours(number))
        add_ends(neighbour);
    return covers;
}

/// Returns whether two pieces are whole faces with a common edge that no other face shares and no line
/// is near. Most pieces are.
bool SheetParts::share_free_edge(std::uint32_t p, std::uint32_t q) const {
    const std::uint32_t of_p = pieces_[p].face, of_q = pieces_[q].face;
    if (of_p == of_q || !faces_[of_p].lines.empty() || !faces_[of_q].lines.empty())
        return false;
    const auto is_free = [&](const LinePiece& edge) {
        const auto is_at = [&](std::uint32_t face) {
            const Triangle& t = own_.triangle(face);
            return face != of_p && face != of_q && std::ranges::count(t, edge.p) > 0 &&
                   std::ranges::count(t, edge.q) > 0;
        };
        bool is_near_line = false;
        index_.for_each_overlap(grown(box_of(edge), 3 * near_),
                                [&](std::uint32_t) { is_near_line = true; });
        return !is_near_line && length(edge.q - edge.p) > 4 * near_ &&
               std::ranges::none_of(own_.neighbours(of_p), is_at) &&
               std::ranges::none_of(own_.neighbours(of_q), is_at);
    };
    for (const FaceSide& side : sides_of(p))
        for (const FaceSide& other : sides_of(q))
            if (side.line.p == other.line.q && side.line.q == other.line.p)
                return is_free(side.line);
    return false;
}

/// Returns whether two pieces share more than `near` of a side where no line runs.
bool SheetParts::are_joined(std::uint32_t p, std::uint32_t q) {
    if (!overlap(grown(pieces_[p].box, near_), pieces_[q].box))
        return false;
    if (share_free_edge(p, q))
        return true;
    const std::uint32_t of_p = pieces_[p].face, of_q = pieces_[q].face;
    const std::span<const FaceSide> others = sides_of(q);
    for (const FaceSide& side : sides_of(p)) {
        const Vec3 along = normalized_or_zero(side.line.q - side.line.p);
        const Box3 box = grown(box_of(side.line), near_);
        for (const FaceSide& other : others) {
            if (!overlap(box, box_of(other.line)))
                continue;
            const auto span = common_span(side.line, along, other.line, near_, 2 * near_);
            if (!span)
                continue;
            const LinePiece common{side.line.p + span->from * along,
                                   side.line.p + span->to * along};
            std::vector<LineSpan> covers = covers_of(common, of_p);
            if (of_q != of_p)
                for (const LineSpan& cover : covers_of(common, of_q))
                    covers.push_back(cover);
            if (!uncovered({0, span->to - span->from}, covers, near_).empty())
                return true;
        }
    }
    return false;
}

/// Returns whether the piece at a side is thicker than `near` at a point close to the side. If not, and it
/// narrows there, its other sides are as close.
bool SheetParts::goes_on(const FaceSide& side, const Vec3& point) const {
    const Vec3 inside = point + 1.5 * near_ * side.inward;
    return std::ranges::all_of(sides_of(side.owner), [&](const FaceSide& each) {
        return dot(inside - each.line.p, each.inward) >= 0;
    });
}

/// The faces that may have a side along a crossing.
std::vector<std::uint32_t> SheetParts::faces_along(const SheetCrossing& crossing) {
    const Box3 box = grown(box_of(crossing.line.piece), near_);
    std::vector<std::uint32_t> faces;
    const auto add = [&](std::uint32_t face) { faces.push_back(face); };
    if (own_.normal(crossing.own) != Vec3{})
        for_each_face_at(crossing.own, box, add);
    else // a thin face has no neighbours
        for (std::uint32_t i = 0; i < own_.triangles(); ++i) {
            const Triangle& t = own_.triangle(i);
            if (overlap(box, {min(t[0], min(t[1], t[2])), max(t[0], max(t[1], t[2]))}))
                add(i);
        }
    sort_unique(faces);
    return faces;
}

/// Finds the pieces on both sides of a crossing.
void SheetParts::find_sides(const SheetCrossing& crossing) {
    struct Neighbour {
        LineSpan span;
        FaceSide side;
        bool is_over;
    };
    const LinePiece& line = crossing.line.piece;
    const Vec3 along = normalized_or_zero(line.q - line.p);
    Vec3 upward = other_.sheet.normal(crossing.other);
    std::vector<Neighbour> neighbours;
    std::vector<double> ends;
    for (const std::uint32_t number : faces_along(crossing)) {
        const Face face = cut(number);
        for (std::uint32_t piece = face.first; piece < face.last; ++piece)
            for (const FaceSide& side : sides_of(piece))
                if (const auto span = common_span(line, along, side.line, near_, 2 * near_)) {
                    if (upward == Vec3{}) // the other face is thin
                        upward = side.inward;
                    neighbours.push_back({*span, side, dot(side.inward, upward) > 0});
                    ends.push_back(span->from);
                    ends.push_back(span->to);
                }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i] - ends[i - 1] <= 2 * near_)
            continue;
        const double at = 0.5 * (ends[i] + ends[i - 1]);
        Sides found;
        const Vec3 middle = line.p + at * along;
        for (const Neighbour& n : neighbours)
            if (n.span.from < at && at < n.span.to && goes_on(n.side, middle))
                (n.is_over ? found.over : found.under).push_back(n.side.owner);
        sort_unique(found.over);
        sort_unique(found.under);
        std::vector<Sides>& known = curves_[crossing.curve].sides;
        if (!found.over.empty() && !found.under.empty() && (known.empty() || known.back() != found))
            curves_[crossing.curve].sides.push_back(std::move(found));
    }
}

/// The part of a piece; a new one if it is not reached yet.
std::uint32_t SheetParts::part_of(std::uint32_t piece) {
    if (pieces_[piece].part == kNone) {
        const auto part = static_cast<std::uint32_t>(parts_.size());
        united_.push_back(part);
        parts_.emplace_back();
        reach(piece, part);
    }
    return united(pieces_[piece].part);
}

/// The part to which a part belongs now.
std::uint32_t SheetParts::united(std::uint32_t part) const {
    while (united_[part] != part)
        part = united_[part];
    return part;
}

/// Adds a piece to a part.
void SheetParts::reach(std::uint32_t piece, std::uint32_t number) {
    Part& part = parts_[number];
    pieces_[piece].part = number;
    const std::vector<Vec3>& polygon = pieces_[piece].polygon;
    double farthest = 0, at_most = kUnbounded;
    for (const Vec3& corner : polygon) {
        const auto [distance, slot] = other_.distances.of(corner);
        farthest = std::max(farthest, distance);
        at_most = std::min(at_most, reach_from(polygon, other_.surface.prepared_slot(slot)));
        part.farthest = std::max(part.farthest, FarPoint{distance, corner});
    }
    pieces_[piece].at_most = at_most;
    part.pieces.push_back(piece);
    part.edge.emplace(farthest, piece);
}

void SheetParts::unite(std::uint32_t number, std::uint32_t other_number) {
    if (number == other_number)
        return;
    Part &part = parts_[number], &other = parts_[other_number];
    united_[other_number] = number;
    part.farthest = std::max(part.farthest, other.farthest);
    part.at_most = kUnbounded;
    part.pieces.insert(part.pieces.end(), other.pieces.begin(), other.pieces.end());
    for (; !other.edge.empty(); other.edge.pop())
        part.edge.push(other.edge.top());
    other.pieces.clear();
}

/// Walks a part until a corner is farther than a limit.
void SheetParts::walk(std::uint32_t number, double limit) {
    while (parts_[number].farthest.distance <= limit && !parts_[number].edge.empty()) {
        poll_stop();
        const std::uint32_t piece = parts_[number].edge.top().second;
        parts_[number].edge.pop();
        pieces_[piece].is_passed = true;
        std::vector<std::uint32_t> faces;
        for_each_face_at(pieces_[piece].face, grown(pieces_[piece].box, near_),
                         [&](std::uint32_t face) { faces.push_back(face); });
        sort_unique(faces);
        for (const std::uint32_t face : faces) {
            const auto [first, last] = std::pair(cut(face).first, cut(face).last);
            const bool is_mutual =
                face == pieces_[piece].face ||
                std::ranges::count(own_.neighbours(face), pieces_[piece].face) > 0;
            for (std::uint32_t next = first; next < last; ++next) {
                const bool is_known = pieces_[next].part != kNone;
                if (next == piece || (is_known && part_of(next) == number) ||
                    (is_mutual && pieces_[next].is_passed) || !are_joined(piece, next))
                    continue;
                if (is_known)
                    unite(number, part_of(next));
                else
                    reach(next, number);
            }
        }
    }
}

Proof SheetParts::ends_within(std::uint32_t curve, double limit) {
    return decide(curve, limit, &SheetParts::examine);
}
bool SheetParts::corners_end_within(std::uint32_t curve, double limit) {
    return decide(curve, limit, &SheetParts::examine_corners) == Proof::holds;
}

/// Decides whether the parts on one side of each line of a curve are within a limit.
Proof SheetParts::decide(std::uint32_t number, double limit, Examine check) {
    const auto are_within = [&](const std::vector<std::uint32_t>& pieces) {
        Proof all = Proof::holds;
        for (const std::uint32_t piece : pieces)
            if (all != Proof::fails)
                all = both_hold(all, (this->*check)(piece, limit));
        return all;
    };
    Curve& curve = curves_[number];
    Proof all = Proof::holds;
    for (std::size_t i = 0; i < curve.sides.size() || curve.looked_at < curve.crossings.size();) {
        if (i == curve.sides.size()) {
            find_sides(crossings_[curve.crossings[curve.looked_at++]]);
            continue;
        }
        Proof one = are_within(curve.sides[i].over);
        if (one != Proof::holds)
            one = either_holds(one, are_within(curve.sides[i].under));
        all = both_hold(all, one);
        if (all == Proof::fails)
            break;
        ++i;
    }
    return all;
}

/// As examine(), for the corners of the part's pieces.
Proof SheetParts::examine_corners(std::uint32_t piece, double limit) {
    const std::uint32_t number = part_of(piece);
    walk(number, limit);
    return parts_[number].farthest.distance <= limit ? Proof::holds : Proof::fails;
}

/// Decides whether the part of a piece is within a limit, unless that is known.
Proof SheetParts::examine(std::uint32_t piece, double limit) {
    const std::uint32_t number = part_of(piece);
    Part& part = parts_[number];
    if (part.at_most <= limit)
        return Proof::holds;
    walk(number, limit + options_.rounding);
    if (part.farthest.distance > limit + options_.rounding)
        return Proof::fails;
    ReachSearch::Options options = options_;
    options.limit = limit;
    ReachSearch search(other_.surface, options);
    for (const std::uint32_t i : part.pieces) {
        if (pieces_[i].at_most <= limit)
            continue;
        const std::vector<Vec3>& polygon = pieces_[i].polygon;
        for (std::size_t k = 2; k < polygon.size() && search.proof() == Proof::holds; ++k)
            search.add({polygon[0], polygon[k - 1], polygon[k]});
    }
    if (search.proof() == Proof::holds)
        part.at_most = limit;
    if (search.proof() != Proof::fails)
        return search.proof();
    const Vec3& found = search.counterexample();
    part.farthest = std::max(
        part.farthest,
        FarPoint{other_.surface.nearest(found, WorldSolid::NearestSearch{}).distance, found});
    return Proof::fails;
}

/// The greatest along a curve of what parts on one side reach, or those on the other side if that is less.
FarPoint SheetParts::reach_of(std::uint32_t number, ReachOfPart of_part) const {
    const Part unreached;
    const auto of_pieces = [&](const std::vector<std::uint32_t>& pieces) {
        FarPoint most;
        for (const std::uint32_t piece : pieces) {
            const std::uint32_t part = pieces_[piece].part;
            most = std::max(most, of_part(part == kNone ? unreached : parts_[united(part)]));
        }
        return most;
    };
    FarPoint most;
    for (const auto& [over, under] : curves_.at(number).sides)
        most = std::max(most, std::min(of_pieces(over), of_pieces(under)));
    return most;
}

FarPoint SheetParts::least_reach(std::uint32_t curve) const {
    return reach_of(curve, [](const Part& part) { return part.farthest; });
}

double SheetParts::reach_of_corners(std::uint32_t number) const {
    const Curve& curve = curves_.at(number);
    if (curve.looked_at < curve.crossings.size())
        return kUnbounded;
    return reach_of(number,
                    [](const Part& part) {
                        return part.is_walked() ? part.farthest : FarPoint{kUnbounded, {}};
                    })
        .distance;
}

} // namespace abut
