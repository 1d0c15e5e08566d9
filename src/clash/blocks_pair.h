#pragma once

#include "clash/part_pair.h"

namespace abut {

/// Two parts of which at least one is in mesh blocks. The blocks are tested one against one, with
/// few of them in memory at a time.
///
/// Accuracy    contacts and nearest points are those of whole models, to the last bit.
class BlocksPair final : public PartPair {
public:
    using PartPair::PartPair;

    void for_each_contact(const std::function<void(const Contact&)>& take) override;
    [[nodiscard]] Gap nearest(double bound) override;

private:
    using Held = BlockList::Held;

    [[nodiscard]] bool are_far_apart(const Held& of_a, const Held& of_b, double gap);
    [[nodiscard]] PlacedPair placed(const Held& of_a, const Held& of_b);
};

} // namespace abut
