#include "rigid/tolerance/line_piece.h"

#include <algorithm>
#include <cmath>

namespace abut {

std::optional<LineSpan> common_span(const LinePiece& piece, const Vec3& along,
                                    const LinePiece& other, double near, double longer_than) {
    Vec3 first = other.p, last = other.q;
    double begin = dot(first - piece.p, along), end = dot(last - piece.p, along);
    if (end < begin)
        std::swap(first, last), std::swap(begin, end);
    const LineSpan span{std::max(begin, 0.0), std::min(end, dot(piece.q - piece.p, along))};
    if (!(span.to - span.from > longer_than))
        return std::nullopt;
    for (const double at : {span.from, span.to}) {
        const Vec3 on_other = first + ((at - begin) / (end - begin)) * (last - first);
        if (length_sq(on_other - piece.p - at * along) > near * near)
            return std::nullopt;
    }
    return span;
}

std::optional<LineSpan> near_span(const LinePiece& piece, const Vec3& along, const LinePiece& other,
                                  double near) {
    const double begin = dot(other.p - piece.p, along), end = dot(other.q - piece.p, along);
    // From one end of the other piece to its other end, the offset from the line changes evenly.
    const Vec3 offset = other.p - piece.p - begin * along,
               change = other.q - piece.p - end * along - offset;
    const double a = length_sq(change), b = dot(offset, change),
                 c = length_sq(offset) - near * near;
    double first = 0, last = 1; // shares of the other piece
    if (a > 0) {
        const double square = b * b - a * c;
        if (square < 0)
            return std::nullopt;
        first = std::max(0.0, (-b - std::sqrt(square)) / a);
        last = std::min(1.0, (-b + std::sqrt(square)) / a);
    } else if (c > 0) {
        return std::nullopt;
    }
    if (first > last)
        return std::nullopt;
    const double p = begin + first * (end - begin), q = begin + last * (end - begin);
    const LineSpan span{std::max(std::min(p, q), 0.0),
                        std::min(std::max(p, q), dot(piece.q - piece.p, along))};
    return span.from <= span.to ? std::optional(span) : std::nullopt;
}

std::vector<LineSpan> uncovered(const LineSpan& span, std::vector<LineSpan> covers, double near) {
    std::sort(covers.begin(), covers.end(),
              [](const LineSpan& s, const LineSpan& t) { return s.from < t.from; });
    std::vector<LineSpan> open;
    double from = span.from;
    const auto add = [&](double to) {
        if (to - from > 2 * near)
            open.push_back({from, to});
    };
    for (const LineSpan& cover : covers) {
        add(std::min(span.to, cover.from));
        from = std::max(from, cover.to);
    }
    add(span.to);
    return open;
}

double distance_to_piece(const LinePiece& piece, const Vec3& point) {
    const Vec3 along = piece.q - piece.p;
    const double size = length_sq(along);
    const double share = size > 0 ? std::clamp(dot(point - piece.p, along) / size, 0.0, 1.0) : 0;
    return length(point - piece.p - share * along);
}

Box3 box_of(const LinePiece& piece) {
    return {min(piece.p, piece.q), max(piece.p, piece.q)};
}

} // namespace abut
