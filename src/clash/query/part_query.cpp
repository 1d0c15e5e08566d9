#include <abut/part_query.h>

#include "clash/query/condition.h"
#include "clash/query/part_facts.h"

#include <algorithm>

namespace abut {

bool PartSubject::any_value(std::string_view name,
                            const std::function<bool(std::string_view)>& take) const {
    if (name == "type")
        return take(facts_.type);
    if (name == "name")
        return take(facts_.name);
    if (name == "id")
        return take(facts_.id);
    if (name == "file")
        return take(facts_.file) || take(name_of_file(facts_.file));
    if (facts_.properties == nullptr)
        return false;
    const auto number = facts_.properties->find(name);
    return number && std::ranges::any_of(facts_.properties->of(facts_.part, *number),
                                         [&](const Properties::Entry& entry) {
                                             return take(facts_.properties->values[entry.value]);
                                         });
}

PartQuery PartQuery::parse(std::string_view text) {
    PartQuery query;
    query.condition_ = std::make_shared<const Condition>(parse_condition(text));
    query.text_ = to_text(*query.condition_);
    return query;
}

bool PartQuery::matches(const Scene& scene, std::uint32_t part) const {
    if (condition_ == nullptr)
        return true;
    if (part >= scene.parts.size())
        return false;
    const PartFacts facts = facts_of(scene, part);
    return is_true(*condition_, PartSubject(facts));
}

std::vector<std::string> PartQuery::names() const {
    return names_of(condition_.get());
}

} // namespace abut
