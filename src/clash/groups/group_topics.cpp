#include "clash/groups/group_topics.h"

#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/topics.h>

#include "core/uuid.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

/// The name space of the GUIDs of topics. It must never change.
constexpr std::string_view kTopicSpace = "7b0a6a52-6c1e-5f0d-9a83-2f4f6a1f5c20";

} // namespace

std::string group_topic_guid(std::string_view group) {
    return uuid_of_name(kTopicSpace, "group " + std::string(group));
}

std::string clash_topic_guid(std::uint64_t clash) {
    return uuid_of_name(kTopicSpace, "clash " + clash_id_text(clash));
}

Topic fresh_topic(std::string_view group, std::string_view name, std::string_view what) {
    Topic topic;
    topic.guid = group_topic_guid(group);
    topic.title = name;
    topic.description = what;
    topic.status = "open";
    topic.type = "Clash";
    topic.group = group;
    return topic;
}

Topic fresh_topic_of_clash(std::uint64_t clash, const std::string& a, const std::string& b) {
    Topic topic;
    topic.guid = clash_topic_guid(clash);
    topic.title = a + " \u00D7 " + b;
    topic.status = "open";
    topic.type = "Clash";
    topic.clashes = {clash};
    return topic;
}

std::vector<Topic> topics_of_groups(const ClashReport& report) {
    std::unordered_map<std::string, const Topic*> known;
    for (const Topic& topic : report.topics)
        known.emplace(topic.guid, &topic);
    std::vector<Topic> topics;
    for (const ClashGroup* group : innermost_groups(report.groups)) {
        const auto found = known.find(group_topic_guid(group->id));
        Topic& topic = topics.emplace_back(found != known.end()
                                               ? *found->second
                                               : fresh_topic(group->id, group->name, group->what));
        if (found != known.end())
            known.erase(found);
        topic.clashes.clear();
        for (const std::uint32_t clash : group->clashes)
            topic.clashes.push_back(report.clashes[clash].id);
        std::ranges::sort(topic.clashes);
        topic.clashes.erase(std::unique(topic.clashes.begin(), topic.clashes.end()),
                            topic.clashes.end());
    }
    for (const Topic& topic : report.topics)
        if (known.contains(topic.guid))
            topics.push_back(topic);
    return topics;
}

} // namespace abut
