#include "massive/coordination/topic_merge.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace abut {

namespace {

struct TopicField {
    const char* name;
    std::string Topic::*member;
};

constexpr TopicField kTopicFields[]{
    {"title", &Topic::title},       {"description", &Topic::description},
    {"status", &Topic::status},     {"type", &Topic::type},
    {"priority", &Topic::priority}, {"stage", &Topic::stage},
    {"assignee", &Topic::assignee}, {"due", &Topic::due},
    {"group", &Topic::group},
};

/// A value that only one side has changed is the changed one. Where both have, `stored` stays.
/// Returns whether that is a conflict.
bool merge_text(const std::string& base, std::string& stored, const std::string& edited) {
    if (edited == base || edited == stored)
        return false;
    if (stored != base)
        return true;
    stored = edited;
    return false;
}

/// Adds the elements that the editor has added, and removes those that the editor has removed. The
/// order of `stored` stays.
template <typename Element>
void merge_list(const std::vector<Element>& base, std::vector<Element>& stored,
                const std::vector<Element>& edited) {
    const auto has = [](const std::vector<Element>& list, const Element& element) {
        return std::ranges::find(list, element) != list.end();
    };
    std::erase_if(stored, [&](const Element& element) {
        return has(base, element) && !has(edited, element);
    });
    for (const Element& element : edited)
        if (!has(base, element) && !has(stored, element))
            stored.push_back(element);
}

const TopicComment* find_comment(const Topic& topic, const std::string& guid) {
    const auto found = std::ranges::find(topic.comments, guid, &TopicComment::guid);
    return found == topic.comments.end() ? nullptr : &*found;
}

/// Comments are added and changed, and removed where the editor has removed them.
void merge_comments(const Topic& base, Topic& stored, const Topic& edited,
                    std::vector<TopicConflict>& conflicts) {
    std::erase_if(stored.comments, [&](const TopicComment& comment) {
        const TopicComment* before = find_comment(base, comment.guid);
        return before != nullptr && before->text == comment.text &&
               find_comment(edited, comment.guid) == nullptr;
    });
    for (const TopicComment& comment : edited.comments) {
        const auto mine = std::ranges::find(stored.comments, comment.guid, &TopicComment::guid);
        const TopicComment* before = find_comment(base, comment.guid);
        if (mine == stored.comments.end()) {
            if (before == nullptr || before->text != comment.text)
                stored.comments.push_back(comment);
            continue;
        }
        const std::string was = before == nullptr ? mine->text : before->text;
        if (merge_text(was, mine->text, comment.text))
            conflicts.push_back(
                {stored.guid, stored.title, "comment", was, mine->text, comment.text});
        const std::string& seen = before == nullptr ? mine->viewpoint : before->viewpoint;
        if (!comment.viewpoint.empty() && comment.viewpoint != seen)
            mine->viewpoint = comment.viewpoint;
    }
    std::ranges::stable_sort(stored.comments, {}, [](const TopicComment& comment) {
        return std::tie(comment.time, comment.guid);
    });
}

} // namespace

Topic merge_topic(const Topic& base, const Topic& stored, const Topic& edited,
                  std::vector<TopicConflict>& conflicts) {
    Topic merged = stored;
    for (const TopicField& field : kTopicFields)
        if (merge_text(base.*field.member, merged.*field.member, edited.*field.member))
            conflicts.push_back({stored.guid, stored.title, field.name, base.*field.member,
                                 stored.*field.member, edited.*field.member});
    merge_list(base.labels, merged.labels, edited.labels);
    merge_list(base.reference_links, merged.reference_links, edited.reference_links);
    merge_list(base.clashes, merged.clashes, edited.clashes);
    merge_comments(base, merged, edited, conflicts);
    return merged;
}

} // namespace abut
