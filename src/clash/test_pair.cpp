#include "clash/test_pair.h"

namespace abut {

namespace {

std::optional<LeftOut> why_left_out(const Clash& clash, bool tolerated, const PairTerms& terms) {
    if (tolerated)
        return LeftOut::tolerated;
    const auto wanted = [&](ClashKind kind) {
        return (terms.kinds >> static_cast<unsigned>(kind) & 1U) != 0;
    };
    // An undecided clash may be of either kind.
    const bool may_be_wanted =
        clash.kind == ClashKind::undecided && (wanted(ClashKind::hard) || wanted(ClashKind::touch));
    if (!wanted(clash.kind) && !may_be_wanted)
        return LeftOut::other_kind;
    return std::nullopt;
}

} // namespace

PairAnswer test_pair(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                     std::string_view id_b, const PairTerms& terms) {
    PairAnswer answer;
    const auto classify = [&](double clearance, double touch) {
        const double rounding = 0.5 * terms.rounding;
        return classify_by_id({a.model, a.blocks, a.world_from_mesh, a.box, rounding}, id_a,
                              {b.model, b.blocks, b.world_from_mesh, b.box, rounding}, id_b,
                              clearance, touch);
    };
    answer.clash = classify(terms.clearance, terms.touch);
    if (!answer.clash)
        return answer;
    answer.clash->neighbours = terms.neighbours;
    // With the tolerated depth in place of the touch tolerance, `touch` means that the parts meet no
    // deeper than is tolerated.
    const auto is_tolerated = [&] {
        if (terms.tolerated < 0 || -answer.clash->distance > terms.tolerated)
            return false;
        if (answer.clash->kind == ClashKind::touch)
            return true;
        if (answer.clash->kind != ClashKind::hard && answer.clash->kind != ClashKind::undecided)
            return false;
        const std::optional<Clash> met =
            terms.tolerated > terms.touch ? classify(0, terms.tolerated) : answer.clash;
        return met && met->kind == ClashKind::touch;
    };
    answer.left_out = why_left_out(*answer.clash, is_tolerated(), terms);
    return answer;
}

} // namespace abut
