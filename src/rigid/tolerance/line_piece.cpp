#include "rigid/tolerance/line_piece.h"

#include <algorithm>

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

Box3 box_of(const LinePiece& piece) {
    return {min(piece.p, piece.q), max(piece.p, piece.q)};
}

} // namespace abut
