#pragma once

#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Groups of clashes: the issues that people talk about, in place of pairs of parts.
/// docs/clash-groups.md defines each criterion.
namespace abut {

struct ClashReport;

/// A criterion by which clashes are grouped.
enum class GroupBy : std::uint8_t { part, place, storey, system, types, discipline };
inline constexpr std::array kGroupCriteria{GroupBy::part,   GroupBy::place, GroupBy::storey,
                                           GroupBy::system, GroupBy::types, GroupBy::discipline};
/// "part", "place", "storey", "system", "types", "discipline".
const char* to_string(GroupBy by);
/// Returns criteria as the command writes them: "storey,part".
std::string to_string(const std::vector<GroupBy>& by);
/// Parses "storey,part".
///
/// Errors      Error{bad_argument} for an unknown word, a word given twice, or no word.
std::vector<GroupBy> parse_grouping(std::string_view text);

/// The property that the clashes of a group share.
enum class GroupKind : std::uint8_t {
    part,   ///< all clashes have one part in common
    copies, ///< parts that duplicate each other, directly or through others
    place,
    storey,
    system,
    types,
    discipline,
};
/// "part", "copies", "place", "storey", "system", "types", "discipline".
const char* to_string(GroupKind kind);

/// The fate of a group between two jobs of a store; see docs/clash-groups.md.
enum class GroupChange : std::uint8_t {
    fresh,    ///< "new": no clash of it was there before
    active,   ///< it was there before
    moved,    ///< it was there before, and one of its clashes has moved
    reopened, ///< it was resolved before, and it has a clash again
    resolved, ///< none of its clashes exists any more
};
inline constexpr std::array kGroupChanges{GroupChange::fresh, GroupChange::active,
                                          GroupChange::moved, GroupChange::reopened,
                                          GroupChange::resolved};
/// "new", "active", "moved", "reopened", "resolved".
const char* to_string(GroupChange change);

/// Clashes that share a property. Groups can hold groups: those of the next criterion.
struct ClashGroup {
    /// 16 hexadecimal digits; docs/clash-groups.md says of what. They do not depend on the order of
    /// files and parts. A store keeps ids from job to job.
    std::string id;
    std::string name; ///< one line for people
    std::string what; ///< the types that clash, most frequent first: "14 IfcPipeSegment, 2 IfcBeam"
    GroupKind kind = GroupKind::part;
    /// The property that all clashes share, as text. part, copies: the file's name, "/" and the
    /// part's id; place: the id of the clash in its middle; others: the value of the property.
    std::string key;
    std::vector<std::uint32_t> clashes; ///< indices in ClashReport::clashes, ascending
    std::vector<ClashGroup> groups;     ///< if any, every clash is in exactly one of them
    Box3 bounds;                        ///< of the witness points of its clashes
    Vec3 centre; ///< place: the point that its clashes are near; others: the middle of `bounds`
    std::array<std::uint64_t, 6> counts{}; ///< number of clashes of each ClashKind
    double deepest = 0; ///< metres; the smallest distance of a clash, negative if parts meet
    /// The part that all clashes share, as model and part (kind `part`).
    std::optional<std::array<std::uint32_t, 2>> part;
    std::optional<GroupChange> change; ///< since the previous job; set only for a store
};

/// A group of an earlier grouping, to which clashes return.
struct EarlierGroup {
    std::string id, parent; ///< parent: the id of the group around it; empty: none
    std::string name;
    GroupKind kind = GroupKind::part;
    std::string key;
    Vec3 centre;
    std::vector<std::uint64_t> clashes; ///< ids of all clashes that it ever had
};

struct GroupOptions {
    /// The criteria, outermost first; each divides the groups of the one before. The exception is
    /// `part`: its groups are not divided, and the next criterion groups the clashes that it left.
    std::vector<GroupBy> by{GroupBy::part, GroupBy::place};
    /// `part`: how many clashes must share a part to be a group, if another criterion follows.
    std::uint32_t least = 4;
    /// `place`: the largest distance of a clash from the centre of its place, metres.
    double reach = 6;
    /// Innermost groups of the last grouping by the same criteria.
    std::vector<EarlierGroup> earlier{};
    Progress progress{};
};

/// The numbers of one job of a store, for a chart over time.
struct JobCounts {
    std::int64_t finished = 0;               ///< seconds since 1970
    std::array<std::uint64_t, 6> kinds{};    ///< clashes of each ClashKind
    std::array<std::uint64_t, 5> statuses{}; ///< clashes of each ClashStatus after the job
    std::array<std::uint64_t, 5> groups{};   ///< groups of each GroupChange; zeros: not grouped
};

/// Groups the clashes of a report. Every clash is in exactly one innermost group.
///
/// In          models: those of the report.
/// Out         the outermost groups: storeys, systems, types and disciplines by name, others the
///             largest first.
/// Errors      Error{bad_argument}: no criterion, one given twice, a reach that is not a positive
///             length, or a clash whose part is not among the models. Error{interrupted}.
/// Cost        O(n log n) for n clashes; `place` visits the pairs of clashes within its reach.
std::vector<ClashGroup> group_clashes(const ClashReport& report, const std::vector<Scene>& models,
                                      const GroupOptions& options = {});

/// Returns the groups that hold no other group, in order.
std::vector<const ClashGroup*> innermost_groups(const std::vector<ClashGroup>& groups);

/// Returns the innermost group of each clash of a report; null if the report is not grouped.
std::vector<const ClashGroup*> groups_of_clashes(const ClashReport& report);

} // namespace abut
