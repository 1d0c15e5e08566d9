#include "clash/test_pair.h"

#include <algorithm>

namespace abut {

namespace {

std::optional<LeftOut> why_left_out(const Clash& clash, const PairTerms& terms) {
    const bool meets = clash.kind == ClashKind::touch || clash.kind == ClashKind::hard;
    // A touch that is deeper than the tolerated depth, but not than the touch tolerance, stays.
    const bool is_tolerated =
        terms.tolerated >= terms.touch
            ? clash.kind == ClashKind::touch
            : meets && terms.tolerated >= 0 && -clash.distance <= terms.tolerated;
    if (is_tolerated)
        return LeftOut::tolerated;
    if ((terms.kinds >> static_cast<unsigned>(clash.kind) & 1U) == 0)
        return LeftOut::other_kind;
    return std::nullopt;
}

} // namespace

PairAnswer test_pair(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                     std::string_view id_b, const PairTerms& terms) {
    PairAnswer answer;
    // With the larger of both depths as touch tolerance, `touch` means at most the tolerated depth.
    answer.clash =
        classify_by_id(a, id_a, b, id_b, terms.clearance, std::max(terms.touch, terms.tolerated));
    if (answer.clash) {
        answer.clash->neighbours = terms.neighbours;
        answer.left_out = why_left_out(*answer.clash, terms);
    }
    return answer;
}

} // namespace abut
