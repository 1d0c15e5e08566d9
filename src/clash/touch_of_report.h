#pragma once

#include <abut/clash.h>

#include "clash/rules/pair_precision.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace abut {

/// The touch tolerance that a report names, from its options and candidate pairs.
class TouchOfReport {
public:
    /// Adds a candidate pair of parts.
    void add(const PairPrecision& precision, std::size_t i, std::size_t k);

    /// Sets the members that say so of a report, whose models are complete.
    void tell(const ClashOptions& options, ClashReport& report) const;

private:
    double largest_ = -1; ///< negative: there is no pair yet
    double least_ = 0;
    PairPrecision::Origin origin_;
};

} // namespace abut
