#include "rigid/tolerance/sheet_border.h"

#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut {

namespace {

std::vector<Box3> boxes_of_sides(const std::vector<FaceSide>& sides) {
    std::vector<Box3> boxes;
    boxes.reserve(sides.size());
    for (const FaceSide& side : sides)
        boxes.push_back(box_of(side.line));
    return boxes;
}

double distance_to_line(const Vec3& point, const LinePiece& line) {
    const Vec3 along = line.q - line.p;
    const double size = length_sq(along);
    const double share = size > 0 ? std::clamp(dot(point - line.p, along) / size, 0.0, 1.0) : 0;
    return length(point - line.p - share * along);
}

/// Where a plane cuts a triangle; none if it does not, or if they are all but parallel.
std::optional<LinePiece> chord_of(const Triangle& face, const Vec3& normal, const Vec3& on_plane,
                                  const Vec3& across) {
    constexpr double kParallel = 1e-5;
    if (length_sq(cross(normal, across)) < kParallel * kParallel)
        return std::nullopt;
    std::vector<Vec3> ends;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = face[k], &q = face[(k + 1) % 3];
        const double at_p = dot(p - on_plane, across), at_q = dot(q - on_plane, across);
        if ((at_p < 0) != (at_q < 0))
            ends.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    return ends.size() == 2 ? std::optional<LinePiece>({ends[0], ends[1]}) : std::nullopt;
}

/// Places on a chord at which to ask whether a border edge is nearest, as shares of its length: dense
/// over the edge, and at its ends.
std::vector<double> places_on(const LinePiece& chord, const LinePiece& edge) {
    constexpr int kOver = 8, kBeside = 12;
    const Vec3 along = normalized_or_zero(edge.q - edge.p);
    const double first = dot(chord.p - edge.p, along), last = dot(chord.q - edge.p, along),
                 size = length(edge.q - edge.p);
    double begin = 0, end = 1; // of the part over the edge
    if (first != last) {
        const double at_p = -first / (last - first), at_q = (size - first) / (last - first);
        begin = std::clamp(std::min(at_p, at_q), 0.0, 1.0);
        end = std::clamp(std::max(at_p, at_q), 0.0, 1.0);
    }
    std::vector<double> places{0, 1};
    for (int i = 0; i <= kOver; ++i)
        places.push_back(begin + (end - begin) * i / kOver);
    for (int i = 1; i <= kBeside; ++i) {
        places.push_back(begin - begin * std::ldexp(1, -i));
        places.push_back(end + (1 - end) * std::ldexp(1, -i));
    }
    return places;
}

/// The place on a chord that is nearest to an edge, as a share of its length.
double nearest_place(const LinePiece& chord, const LinePiece& edge) {
    return nearest_on_segments(chord.q - chord.p, edge.q - edge.p, edge.p - chord.p).s;
}

/// Where a chord meets a line in the same face, as a share of its length.
std::optional<double> crossing_place(const LinePiece& chord, const DirectedPiece& line,
                                     const Vec3& normal, double near) {
    const Vec3 across = cross(normal, line.along);
    const double at_p = dot(chord.p - line.piece.p, across),
                 at_q = dot(chord.q - line.piece.p, across);
    if ((at_p < 0) == (at_q < 0))
        return std::nullopt;
    const double share = at_p / (at_p - at_q);
    const Vec3 on = chord.p + share * (chord.q - chord.p);
    return distance_to_line(on, line.piece) <= near ? std::optional(share) : std::nullopt;
}

/// The part of a chord that is within a distance of an edge.
std::optional<LinePiece> part_within(const LinePiece& chord, const LinePiece& edge, double reach) {
    if (!overlap(box_of(chord), box_of(edge), reach))
        return std::nullopt;
    const auto at = [&](double share) { return chord.p + share * (chord.q - chord.p); };
    const double nearest = nearest_place(chord, edge);
    if (distance_to_line(at(nearest), edge) > reach)
        return std::nullopt;
    const auto end = [&](double out) {
        double in = nearest;
        if (distance_to_line(at(out), edge) <= reach)
            return out;
        for (int i = 0; i < 50; ++i)
            (distance_to_line(at(0.5 * (in + out)), edge) <= reach ? in : out) = 0.5 * (in + out);
        return in;
    };
    const LinePiece part{at(end(0)), at(end(1))};
    return part.p == part.q ? std::nullopt : std::optional(part);
}

} // namespace

SheetBorder::SheetBorder(const Sheet& sheet, const WorldSolid& surface, double near)
    : surface_(surface), near_(near), sides_(border_of(sheet, near)),
      index_(boxes_of_sides(sides_)) {}

bool SheetBorder::is_nearest(const FaceSide& side, const Vec3& point, double reach) const {
    const double distance = distance_to_line(point, side.line);
    if (distance > reach)
        return false;
    const double nearer = distance - near_;
    return nearer <= 0 ||
           !(surface_.nearest(point, {.bound = nearer, .enough = nearer}).distance < nearer);
}

std::vector<DirectedPiece> SheetBorder::ends_on(const OtherFace& face, double reach) const {
    Box3 box;
    for (const Vec3& corner : face.corners)
        extend(box, corner);
    std::vector<BorderLine> lines;
    index_.for_each_overlap(grown(box, reach), [&](std::uint32_t i) {
        if (const auto chord =
                chord_of(face.corners, face.normal, sides_[i].line.p, sides_[i].inward))
            add_lines(i, *chord, face, reach, lines);
    });
    bridge(lines, reach);
    std::vector<DirectedPiece> ends;
    ends.reserve(lines.size());
    for (const BorderLine& line : lines)
        ends.push_back({line.line, normalized_or_zero(line.line.q - line.line.p)});
    return ends;
}

bool SheetBorder::are_neighbours(std::uint32_t i, std::uint32_t j) const {
    const LinePiece &line = sides_[i].line, &other = sides_[j].line;
    for (const Vec3& end : {line.p, line.q})
        if (std::min(length(end - other.p), length(end - other.q)) <= near_)
            return true;
    return false;
}

/// Adds lines between those of border edges that meet. Where the border is twisted, their planes differ,
/// and their lines may end beside each other where both edges are as near.
void SheetBorder::bridge(std::vector<BorderLine>& lines, double reach) const {
    const std::size_t count = lines.size();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const auto [side, line] = lines[i];
            const auto [other_side, other] = lines[j];
            if (side == other_side || !are_neighbours(side, other_side))
                continue;
            LinePiece gap{line.p, other.p};
            for (const Vec3& p : {line.p, line.q})
                for (const Vec3& q : {other.p, other.q})
                    if (length_sq(q - p) < length_sq(gap.q - gap.p))
                        gap = {p, q};
            const auto is_between = [&, side = side, other_side = other_side](double share) {
                const Vec3 at = gap.p + share * (gap.q - gap.p);
                return is_nearest(sides_[side], at, reach) ||
                       is_nearest(sides_[other_side], at, reach);
            };
            if (gap.p != gap.q && is_between(0.25) && is_between(0.5) && is_between(0.75))
                lines.push_back({side, gap});
        }
}

/// Adds the parts of a line to which a border edge is nearest.
void SheetBorder::add_lines(std::uint32_t number, const LinePiece& whole, const OtherFace& face,
                            double reach, std::vector<BorderLine>& lines) const {
    const FaceSide& side = sides_[number];
    const std::optional<LinePiece> in_reach = part_within(whole, side.line, reach);
    if (!in_reach)
        return;
    const LinePiece& chord = *in_reach;
    const auto at = [&](double share) { return chord.p + share * (chord.q - chord.p); };
    std::vector<double> places = places_on(chord, side.line);
    places.push_back(nearest_place(chord, side.line));
    for (const DirectedPiece& crossed : face.crossed)
        if (const auto place = crossing_place(chord, crossed, face.normal, near_))
            places.push_back(*place);
    std::sort(places.begin(), places.end());
    std::vector<bool> is_part;
    is_part.reserve(places.size());
    for (const double place : places)
        is_part.push_back(is_nearest(side, at(place), reach));
    const auto boundary = [&](double in, double out) {
        for (int i = 0; i < 50; ++i)
            (is_nearest(side, at(0.5 * (in + out)), reach) ? in : out) = 0.5 * (in + out);
        return in;
    };
    for (std::size_t i = 0, j = 0; i < places.size(); i = j + 1) {
        for (j = i; j + 1 < places.size() && is_part[i] && is_part[j + 1]; ++j) {
        }
        if (!is_part[i])
            continue;
        const double from = i == 0 ? places[i] : boundary(places[i], places[i - 1]),
                     to = j + 1 == places.size() ? places[j] : boundary(places[j], places[j + 1]);
        // A little more, so that lines that meet leave no gap.
        const double more = 2 * near_ / std::max(length(chord.q - chord.p), near_);
        lines.push_back({number, {at(std::max(0.0, from - more)), at(std::min(1.0, to + more))}});
    }
}

} // namespace abut
