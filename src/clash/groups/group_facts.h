#pragma once

#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/scene.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// A part that clashes.
struct GroupPart {
    std::string key; ///< file name without folders, "/", part id; unique
    std::uint32_t model = 0, part = 0;
};

/// A clash as the grouping sees it.
struct GroupClash {
    std::array<std::uint32_t, 2> part{}; ///< indices in GroupFacts::parts, the smaller first
    Vec3 point;                          ///< the middle of its witness points
};

/// The facts about clashes that groups rest on. They do not depend on the order of files and parts,
/// except that files of the same name in different folders are told apart by their order.
struct GroupFacts {
    const ClashReport& report;
    const std::vector<Scene>& models;
    std::vector<GroupPart> parts;     ///< sorted by key
    std::vector<GroupClash> clashes;  ///< as in the report
    std::vector<std::uint32_t> order; ///< clashes sorted by id, then by parts
    std::vector<std::uint32_t> rank;  ///< the place of each clash in `order`

    [[nodiscard]] const Part& part(std::uint32_t i) const {
        return models[parts[i].model].parts[parts[i].part];
    }
};

/// Errors      Error{bad_argument} for a clash whose part is not among the models.
GroupFacts gather_facts(const ClashReport& report, const std::vector<Scene>& models);

/// Returns the first value of a part's property; empty if it has none.
std::string group_property(const Scene& model, std::uint32_t part, std::string_view name);

/// Returns the value of a criterion that is a property of the two parts: `storey`, `system`,
/// `types` or `discipline`.
std::string property_of_clash(const GroupFacts& facts, std::uint32_t clash, GroupBy by);

/// Orders texts as people do: "Level 2" before "Level 10".
bool natural_less(std::string_view a, std::string_view b);

/// Squared distance. It does not depend on the order of the axes, so that models with other axes
/// give the same groups.
double symmetric_distance_sq(const Vec3& a, const Vec3& b);

} // namespace abut
