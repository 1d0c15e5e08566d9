#pragma once

#include "clash/groups/group_facts.h"

#include <cstdint>
#include <vector>

/// Groups by greedy covers: what most of the remaining clashes share becomes the next group.
namespace abut {

/// Clashes that share something, and what they share: a part, or the clash in their middle.
struct Cover {
    std::uint32_t centre = 0;
    std::vector<std::uint32_t> members;
};

/// Takes the part that most of the remaining clashes share, together with these clashes, again and
/// again, until no part is shared by `least` of them. Of equals, the part with the smaller key
/// comes first.
///
/// In          clashes: sorted by rank. Out: without the members of the covers.
std::vector<Cover> cover_by_part(const GroupFacts& facts, std::vector<std::uint32_t>& clashes,
                                 std::uint32_t least);

/// Takes the clash with the most remaining clashes within `reach` of it, itself included, together
/// with these, again and again, until none is left. Of equals, the clash of lower rank comes first.
///
/// In          clashes: sorted by rank.
/// Errors      Error{interrupted}.
std::vector<Cover> cover_by_place(const GroupFacts& facts,
                                  const std::vector<std::uint32_t>& clashes, double reach);

} // namespace abut
