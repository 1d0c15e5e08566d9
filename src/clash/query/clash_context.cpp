#include "clash/query/clash_context.h"

#include <abut/error.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace abut {

namespace {

constexpr std::string_view kGroupName = "group", kOfGroup = "group.", kOfTopic = "topic.";

constexpr std::array<std::pair<std::string_view, std::string Topic::*>, 7> kTopicTexts{
    {{"status", &Topic::status},
     {"title", &Topic::title},
     {"type", &Topic::type},
     {"priority", &Topic::priority},
     {"stage", &Topic::stage},
     {"assignee", &Topic::assignee},
     {"due", &Topic::due}}};

/// Returns all names of groups and topics that a condition may ask for.
std::vector<std::string> context_names() {
    std::vector<std::string> names{"group", "group.id", "group.size", "group.change"};
    for (const ClashKind kind : kClashKinds)
        names.push_back(std::string(kOfGroup) + to_string(kind));
    for (const auto& [name, member] : kTopicTexts)
        names.push_back(std::string(kOfTopic) + std::string(name));
    names.emplace_back("topic.label");
    return names;
}

bool of_innermost(const ClashGroup& group, std::string_view name,
                  const std::function<bool(std::string_view)>& take) {
    if (name == "size")
        return take(std::to_string(group.clashes.size()));
    if (name == "change")
        return group.change && take(to_string(*group.change));
    for (const ClashKind kind : kClashKinds)
        if (name == to_string(kind))
            return take(std::to_string(group.counts.at(static_cast<std::size_t>(kind))));
    return false;
}

} // namespace

bool is_of_context(std::string_view name) {
    return name == kGroupName || name.starts_with(kOfGroup) || name.starts_with(kOfTopic);
}

void require_known_context(std::string_view name) {
    if (!is_of_context(name))
        return;
    const std::vector<std::string> known = context_names();
    if (std::ranges::find(known, name) != known.end())
        return;
    std::string list;
    for (const std::string& word : known)
        list += (list.empty() ? "" : ", ") + word;
    throw Error(ErrorCode::bad_argument,
                "\"" + std::string(name) + "\" is not known of groups and topics: one of " + list);
}

ClashContext::ClashContext(const ClashReport& report)
    : report_(report), innermost_(groups_of_clashes(report)) {
    add(report.groups, nullptr);
    for (const Topic& topic : report.topics) {
        if (!topic.group.empty())
            of_group_[topic.group].push_back(&topic);
        else
            for (const std::uint64_t clash : topic.clashes)
                of_clash_[clash].push_back(&topic);
    }
}

void ClashContext::add(const std::vector<ClashGroup>& groups, const ClashGroup* parent) {
    for (const ClashGroup& group : groups) {
        parents_.emplace(&group, parent);
        add(group.groups, &group);
    }
}

bool ClashContext::any_value(std::uint32_t clash, std::string_view name, const Take& take) const {
    if (name.starts_with(kOfTopic))
        return of_topics(clash, name.substr(kOfTopic.size()), take);
    const ClashGroup* const innermost = innermost_[clash];
    if (innermost == nullptr)
        return false;
    const bool is_id = name == "group.id";
    if (name != kGroupName && !is_id)
        return of_innermost(*innermost, name.substr(kOfGroup.size()), take);
    for (const ClashGroup* group = innermost; group != nullptr; group = parents_.at(group))
        if (take(is_id ? group->id : group->name))
            return true;
    return false;
}

bool ClashContext::of_topics(std::uint32_t clash, std::string_view name, const Take& take) const {
    const auto any_of = [&](const std::vector<const Topic*>& topics) {
        return std::ranges::any_of(topics, [&](const Topic* topic) {
            if (name == "label")
                return std::ranges::any_of(topic->labels, take);
            for (const auto& [word, member] : kTopicTexts)
                if (name == word)
                    return !(topic->*member).empty() && take(topic->*member);
            return false;
        });
    };
    if (const auto found = of_clash_.find(report_.clashes[clash].id);
        found != of_clash_.end() && any_of(found->second))
        return true;
    if (innermost_[clash] == nullptr)
        return false;
    const auto found = of_group_.find(innermost_[clash]->id);
    return found != of_group_.end() && any_of(found->second);
}

} // namespace abut
