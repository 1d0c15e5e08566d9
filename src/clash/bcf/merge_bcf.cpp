#include <abut/clash_bcf.h>

#include "clash/bcf/topic_fields.h"
#include "core/uuid.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut {

namespace {

using TopicsByGuid = std::unordered_map<std::string, Topic>;

Topic topic_of_bcf(const BcfTopic& from) {
    Topic topic;
    topic.guid = lower_uuid(from.guid);
    topic.title = from.title;
    topic.description = without_derived_line(from.description);
    topic.status = topic_status(from.status);
    topic.type = from.type;
    topic.priority = from.priority;
    topic.stage = from.stage;
    topic.assignee = from.assigned_to;
    topic.due = parse_bcf_time(from.due_date) ? from.due_date.substr(0, 10) : "";
    std::ranges::remove_copy_if(from.labels, std::back_inserter(topic.labels),
                                [](const std::string& label) { return is_derived_label(label); });
    topic.reference_links = from.reference_links;
    topic.created_by = from.creation_author;
    topic.created = parse_bcf_time(from.creation_date).value_or(0);
    topic.modified_by = from.modified_author.empty() ? from.creation_author : from.modified_author;
    topic.modified = parse_bcf_time(from.modified_date).value_or(topic.created);
    for (const BcfComment& comment : from.comments)
        topic.comments.push_back({lower_uuid(comment.guid), comment.author, comment.text,
                                  parse_bcf_time(comment.date).value_or(0),
                                  lower_uuid(comment.viewpoint)});
    return topic;
}

TopicsByGuid by_guid(std::vector<Topic> topics) {
    TopicsByGuid result;
    for (Topic& topic : topics) {
        const std::string guid = topic.guid;
        result.emplace(guid, std::move(topic));
    }
    return result;
}

/// Returns whether a topic says no more than the clashes do.
bool is_untouched(Topic topic, const Topic& fresh) {
    topic.created = topic.modified = 0;
    topic.created_by = topic.modified_by = "";
    return topic == fresh;
}

/// Adds the elements that the editor's list lacks.
template <typename Element, typename Key>
void unite_lists(const std::vector<Element>& stored, std::vector<Element>& edited, Key key) {
    for (const Element& element : stored)
        if (std::ranges::find(edited, std::invoke(key, element), key) == edited.end())
            edited.push_back(element);
}

/// Makes a topic, edited nobody knows since when, an edit of the stored one.
void merge_by_time(const Topic& stored, Topic& edited) {
    if (edited.modified < stored.modified) {
        Topic kept = stored;
        kept.labels = std::move(edited.labels);
        kept.reference_links = std::move(edited.reference_links);
        kept.comments = std::move(edited.comments);
        edited = std::move(kept);
    }
    unite_lists(stored.labels, edited.labels, std::identity());
    unite_lists(stored.reference_links, edited.reference_links, std::identity());
    unite_lists(stored.comments, edited.comments, &TopicComment::guid);
}

} // namespace

std::optional<std::int64_t> bcf_revision(const BcfFile& file) {
    const auto found = std::ranges::find(file.entries, kRevisionEntry, &BcfEntry::name);
    if (found == file.entries.end() || !found->bytes.starts_with(kRevisionWord))
        return std::nullopt;
    const char* const first = found->bytes.data() + std::string_view(kRevisionWord).size();
    const char* const last = found->bytes.data() + found->bytes.size();
    std::int64_t revision = 0;
    const auto [end, error] = std::from_chars(first, last, revision);
    return error == std::errc() && revision >= 0 ? std::optional(revision) : std::nullopt;
}

TopicMerge merge_bcf(const Store& store, const BcfFile& file, const MergeOptions& options) {
    MergeOptions merge = options;
    if (!merge.base)
        merge.base = bcf_revision(file);
    // The file of another store may say a revision that this one has not reached.
    if (!options.base && merge.base && *merge.base > topics_revision(store))
        merge.base.reset();
    const TopicsByGuid fresh = by_guid(untouched_topics(store));
    const TopicsByGuid stored = by_guid(read_topics(store));
    std::vector<Topic> edited;
    for (const BcfTopic& from : file.topics) {
        Topic topic = topic_of_bcf(from);
        const auto known = stored.find(topic.guid);
        const auto untouched = fresh.find(topic.guid);
        const Topic* const before = known != stored.end()      ? &known->second
                                    : untouched != fresh.end() ? &untouched->second
                                                               : nullptr;
        if (before != nullptr) {
            topic.group = before->group;
            topic.clashes = before->clashes;
            if (topic.description.empty())
                topic.description = before->description;
            if (before->priority.empty() && topic.priority == derived_priority(from.description))
                topic.priority = "";
        }
        if (known == stored.end() && before != nullptr && is_untouched(topic, *before))
            continue;
        if (known != stored.end() && !merge.base)
            merge_by_time(known->second, topic);
        edited.push_back(std::move(topic));
    }
    TopicMerge result = merge_topics(store, edited, merge);
    result.warnings = file.warnings;
    return result;
}

} // namespace abut
