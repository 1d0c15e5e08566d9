#pragma once

#include "clash/classify_pair.h"
#include "clash/rules/rule_table.h"

namespace abut {

/// The clash of a pair under its terms.
struct PairAnswer {
    std::optional<Clash> clash;
    std::optional<LeftOut> left_out; ///< why the terms leave the clash out, if they do
};

/// Calls classify_by_id with the terms of a pair. The tolerated depth is decided as accurately as
/// the touch tolerance. `neighbours` of the clash is filled in.
PairAnswer test_pair(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                     std::string_view id_b, const PairTerms& terms);

} // namespace abut
