#include "rigid/tolerance/sheet_border.h"

#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <array>
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

/// Where a plane cuts a triangle; none if it does not, or if they are all but parallel.
std::optional<LinePiece> chord_of(const Triangle& face, const Vec3& normal, const Vec3& on_plane,
                                  const Vec3& across) {
    constexpr double kParallel = 1e-5;
    if (length_sq(cross(normal, across)) < kParallel * kParallel)
        return std::nullopt;
    std::array<double, 3> height{};
    for (std::size_t k = 0; k < 3; ++k)
        height[k] = dot(face[k] - on_plane, across);
    std::array<Vec3, 2> ends;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if ((height[k] < 0) != (height[next] < 0))
            ends[count++] =
                face[k] + (height[k] / (height[k] - height[next])) * (face[next] - face[k]);
    }
    return count == 2 ? std::optional<LinePiece>({ends[0], ends[1]}) : std::nullopt;
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

/// The points of a chord and an edge that are nearest to each other, as shares of their lengths.
SegmentPoints nearest_places(const LinePiece& chord, const LinePiece& edge) {
    return nearest_on_segments(chord.q - chord.p, edge.q - edge.p, edge.p - chord.p);
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
    return distance_to_piece(line.piece, on) <= near ? std::optional(share) : std::nullopt;
}

Vec3 at(const LinePiece& line, double share) {
    return line.p + share * (line.q - line.p);
}

} // namespace

SheetBorder::SheetBorder(const Sheet& sheet, const WorldSolid& surface, double near)
    : surface_(surface), near_(near), sides_(border_of(sheet, near)),
      index_(boxes_of_sides(sides_)) {}

/// Returns a length by which the surface is nearer to a point than a border edge; 0 if it is not nearer.
double SheetBorder::nearer_by(const FaceSide& side, const Vec3& point, Search& search) const {
    const double distance = distance_to_piece(side.line, point) - near_;
    if (distance <= 0)
        return 0;
    const auto found =
        surface_.nearest(point, {.bound = distance, .enough = distance, .seed = &search.nearer});
    if (!(found.distance < distance))
        return 0;
    search.nearer = found.slot;
    return distance - found.distance;
}

bool SheetBorder::is_nearest(const FaceSide& side, const Vec3& point, Search& search) const {
    return nearer_by(side, point, search) == 0;
}

std::vector<DirectedPiece> SheetBorder::ends_on(const OtherFace& face) const {
    if (sides_.empty())
        return {};
    // No point of the face is farther from the surface than its middle is, and half the face's size.
    const auto& [p, q, r] = face.corners;
    const Vec3 middle = (1.0 / 3) * (p + q + r);
    const double half = std::max({length(p - middle), length(q - middle), length(r - middle)});
    const auto nearest = surface_.nearest(middle, WorldSolid::NearestSearch{});
    const double reach = nearest.distance + 2 * half + near_;
    Search search{nearest.slot};
    index_.for_each_overlap(grown({middle, middle}, reach), [&](std::uint32_t i) {
        const FaceSide& side = sides_[i];
        if (distance_to_piece(side.line, middle) > reach)
            return;
        const auto chord = chord_of(face.corners, face.normal, side.line.p, side.inward);
        if (chord && !is_nowhere_nearest(side, *chord, search))
            add_lines(i, *chord, face, search);
    });
    bridge(search);
    std::vector<DirectedPiece> ends;
    ends.reserve(search.lines.size());
    for (const BorderLine& line : search.lines)
        ends.push_back({line.line, normalized_or_zero(line.line.q - line.line.p)});
    return ends;
}

/// The ends of a line at which its edge stops to be nearest.
std::vector<Vec3> SheetBorder::stops_of(const BorderLine& line) {
    std::vector<Vec3> ends;
    if (line.stops[0])
        ends.push_back(line.line.p);
    if (line.stops[1])
        ends.push_back(line.line.q);
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
void SheetBorder::bridge(Search& search) const {
    std::vector<BorderLine>& lines = search.lines;
    const std::size_t count = lines.size();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const FaceSide &side = sides_[lines[i].side], &other = sides_[lines[j].side];
            if (lines[i].side == lines[j].side || !are_neighbours(lines[i].side, lines[j].side))
                continue;
            const auto are_as_near = [&](const Vec3& point) {
                return std::abs(distance_to_piece(side.line, point) -
                                distance_to_piece(other.line, point)) <= 8 * near_;
            };
            const auto is_between = [&](const LinePiece& gap, double share) {
                return is_nearest(side, at(gap, share), search) ||
                       is_nearest(other, at(gap, share), search);
            };
            std::optional<LinePiece> nearest;
            for (const Vec3& p : stops_of(lines[i]))
                for (const Vec3& q : stops_of(lines[j]))
                    if (p != q && are_as_near(p) && are_as_near(q) &&
                        (!nearest || length_sq(q - p) < length_sq(nearest->q - nearest->p)))
                        nearest = LinePiece{p, q};
            if (nearest && is_between(*nearest, 0.25) && is_between(*nearest, 0.5) &&
                is_between(*nearest, 0.75))
                lines.push_back({lines[i].side, *nearest});
        }
}

/// Returns whether the surface is nearer than a border edge to all points of a line. False if that is not
/// known.
bool SheetBorder::is_nowhere_nearest(const FaceSide& side, const LinePiece& line,
                                     const Search& search) const {
    // The distance from a triangle is convex: at an end of the line it is the largest.
    const PreparedTriangle& near = surface_.prepared_slot(search.nearer);
    const double farthest = std::sqrt(std::max(near.distance_sq(line.p), near.distance_sq(line.q)));
    return farthest < std::sqrt(nearest_places(line, side.line).distance_sq) - near_;
}

/// Finds where a border edge stops to be what is nearest, between a place of a chord where it is and one
/// where it is not.
double SheetBorder::end_of_part(const FaceSide& side, const LinePiece& chord, double in, double out,
                                Search& search) const {
    constexpr int kHalvings = 50, kMostNearer = 64;
    // The triangle that is nearer at `out` tells a place where it no longer is. Another triangle may be
    // nearer there, and then tells the next place.
    bool is_in = is_nearest(side, at(chord, out), search);
    for (int i = 0; i < kMostNearer && !is_in; ++i) {
        const Triangle nearer = surface_.world_slot(search.nearer);
        double next = in;
        for (int k = 0; k < kHalvings; ++k) {
            const double between = 0.5 * (next + out);
            const Vec3 point = at(chord, between);
            const bool is_nearer = std::sqrt(point_triangle_distance(point, nearer).distance_sq) <
                                   distance_to_piece(side.line, point) - near_;
            (is_nearer ? out : next) = between;
        }
        is_in = next == in || is_nearest(side, at(chord, next), search);
        out = next;
    }
    return is_in ? out : in;
}

/// Adds the parts of a line to which a border edge is nearest.
void SheetBorder::add_lines(std::uint32_t number, const LinePiece& chord, const OtherFace& face,
                            Search& search) const {
    const FaceSide& side = sides_[number];
    std::vector<double> places = places_on(chord, side.line);
    places.push_back(nearest_places(chord, side.line).s);
    for (const DirectedPiece& crossed : face.crossed)
        if (const auto place = crossing_place(chord, crossed, face.normal, near_))
            places.push_back(*place);
    std::sort(places.begin(), places.end());
    std::vector<bool> is_part;
    is_part.reserve(places.size());
    double nearer_until = 0; // before this place, the surface is nearer than the edge
    for (const double place : places) {
        if (place < nearer_until) {
            is_part.push_back(false);
            continue;
        }
        const double by = nearer_by(side, at(chord, place), search);
        is_part.push_back(by == 0);
        // From place to place, neither distance changes by more than the length between them.
        nearer_until = place + 0.5 * by / length(chord.q - chord.p);
    }
    for (std::size_t i = 0, j = 0; i < places.size(); i = j + 1) {
        for (j = i; j + 1 < places.size() && is_part[i] && is_part[j + 1]; ++j) {
        }
        if (!is_part[i])
            continue;
        const double from = i == 0 ? places[i]
                                   : end_of_part(side, chord, places[i], places[i - 1], search),
                     to = j + 1 == places.size()
                              ? places[j]
                              : end_of_part(side, chord, places[j], places[j + 1], search);
        // A little more, so that lines that meet leave no gap.
        const double more = 2 * near_ / std::max(length(chord.q - chord.p), near_);
        search.lines.push_back(
            {number,
             {at(chord, std::max(0.0, from - more)), at(chord, std::min(1.0, to + more))},
             {from > 0, to < 1}});
    }
}

} // namespace abut
