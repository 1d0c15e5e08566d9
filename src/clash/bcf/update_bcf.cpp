#include <abut/clash_bcf.h>

#include "clash/bcf/topic_fields.h"

#include <algorithm>
#include <map>
#include <optional>

namespace abut {

namespace {

std::string lower_guid(std::string guid) {
    for (char& c : guid)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return guid;
}

/// Adds the elements of the earlier list whose key the later list lacks.
template <typename Element, typename Key>
void keep_others(const std::vector<Element>& earlier, std::vector<Element>& later, const Key& key) {
    for (const Element& element : earlier)
        if (std::ranges::find(later, key(element), key) == later.end())
            later.push_back(element);
}

/// Returns whether a store has changed a topic after the file's last change.
bool is_changed_since(const BcfTopic& earlier, const BcfTopic& later) {
    const std::optional<std::int64_t> changed = parse_bcf_time(later.modified_date);
    const std::optional<std::int64_t> before = parse_bcf_time(
        earlier.modified_date.empty() ? earlier.creation_date : earlier.modified_date);
    return changed && (!before || *changed >= *before);
}

/// Keeps what people have written.
void keep_fields(const BcfTopic& earlier, BcfTopic& later) {
    for (std::string BcfTopic::*const field :
         {&BcfTopic::title, &BcfTopic::type, &BcfTopic::status, &BcfTopic::modified_date,
          &BcfTopic::modified_author, &BcfTopic::due_date, &BcfTopic::assigned_to,
          &BcfTopic::stage})
        if (!(earlier.*field).empty())
            later.*field = earlier.*field;
    if (earlier.priority != derived_priority(earlier.description))
        later.priority = earlier.priority;
    if (const std::string written = without_derived_line(earlier.description); !written.empty()) {
        const std::size_t line = later.description.find(kDerivedLine);
        later.description =
            written + (line == std::string::npos ? "" : "\n" + later.description.substr(line));
    }
    for (const std::string& label : earlier.labels)
        if (!is_derived_label(label) &&
            std::ranges::find(later.labels, label) == later.labels.end())
            later.labels.push_back(label);
    later.reference_links = earlier.reference_links;
}

BcfTopic updated(const BcfTopic& earlier, BcfTopic later) {
    later.folder = earlier.folder;
    later.server_assigned_id = earlier.server_assigned_id;
    later.index = earlier.index;
    later.creation_date = earlier.creation_date;
    later.creation_author = earlier.creation_author;
    if (!is_changed_since(earlier, later))
        keep_fields(earlier, later);
    later.snippet = earlier.snippet;
    later.documents = earlier.documents;
    later.related_topics = earlier.related_topics;
    later.unknown = earlier.unknown;
    later.unknown_markup = earlier.unknown_markup;
    keep_others(earlier.comments, later.comments,
                [](const BcfComment& comment) { return lower_guid(comment.guid); });
    std::ranges::stable_sort(later.comments, {}, &BcfComment::date);
    for (BcfViewpoint viewpoint : earlier.viewpoints) {
        const auto same = [&](const BcfViewpoint& other) {
            return lower_guid(other.guid) == lower_guid(viewpoint.guid);
        };
        if (std::ranges::any_of(later.viewpoints, same))
            continue;
        // A file of that name may be ours now.
        const std::string prefix = viewpoint.guid + "-";
        for (const BcfViewpoint& ours : later.viewpoints) {
            if (!viewpoint.file.empty() && viewpoint.file == ours.file)
                viewpoint.file = prefix + viewpoint.file;
            if (!viewpoint.snapshot_file.empty() && viewpoint.snapshot_file == ours.snapshot_file)
                viewpoint.snapshot_file = prefix + viewpoint.snapshot_file;
        }
        later.viewpoints.push_back(std::move(viewpoint));
    }
    return later;
}

void unite(const std::vector<std::string>& earlier, std::vector<std::string>& later) {
    keep_others(earlier, later, [](const std::string& word) { return word; });
}

} // namespace

BcfFile update_bcf(const BcfFile& earlier, const BcfFile& later) {
    BcfFile result = later;
    result.version = earlier.version;
    std::map<std::string, std::size_t> ours;
    for (std::size_t i = 0; i < result.topics.size(); ++i)
        ours.emplace(lower_guid(result.topics[i].guid), i);
    for (const BcfTopic& topic : earlier.topics) {
        const auto found = ours.find(lower_guid(topic.guid));
        if (found != ours.end())
            result.topics[found->second] = updated(topic, result.topics[found->second]);
        else
            result.topics.push_back(topic);
    }
    std::ranges::sort(result.topics, {}, &BcfTopic::folder);
    keep_others(earlier.entries, result.entries, [](const BcfEntry& entry) { return entry.name; });
    keep_others(earlier.documents, result.documents,
                [](const BcfDocument& document) { return lower_guid(document.guid); });
    if (!earlier.project_id.empty()) {
        result.project_id = earlier.project_id;
        result.project_name = earlier.project_name;
    }
    result.extension_schema = earlier.extension_schema;
    unite(earlier.extensions.types, result.extensions.types);
    unite(earlier.extensions.statuses, result.extensions.statuses);
    unite(earlier.extensions.priorities, result.extensions.priorities);
    unite(earlier.extensions.labels, result.extensions.labels);
    unite(earlier.extensions.users, result.extensions.users);
    unite(earlier.extensions.snippet_types, result.extensions.snippet_types);
    unite(earlier.extensions.stages, result.extensions.stages);
    return result;
}

} // namespace abut
