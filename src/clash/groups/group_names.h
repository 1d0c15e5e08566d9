#pragma once

#include <abut/clash_groups.h>

#include "clash/groups/group_facts.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Ids and names of groups.
namespace abut {

/// Returns the id of a group: 16 hexadecimal digits. `salt` tells groups with equal keys apart.
std::string group_id(std::string_view parent, GroupKind kind, std::string_view key,
                     std::uint32_t salt);

/// Returns a name without regard to other groups.
std::string group_name(const GroupFacts& facts, const ClashGroup& group);

/// Appends the ids of the parts to equal names of groups whose flag `is_new` is set, if one of
/// their namesakes is another group.
void distinguish_names(std::vector<ClashGroup>& groups, const std::vector<bool>& is_new);

/// Returns the types that clash, with their numbers, the most frequent first. For a group about one
/// part these are the types of the other parts.
///
/// In          part: the index of that part in the facts; kNoGroupPart: none.
inline constexpr std::uint32_t kNoGroupPart = ~std::uint32_t{0};
std::string types_in_group(const GroupFacts& facts, const ClashGroup& group, std::uint32_t part);

} // namespace abut
