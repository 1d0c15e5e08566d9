#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Topics: what people say about groups of clashes, kept in a store. docs/coordination.md shows
/// their use, docs/topics.md lists the rules.
namespace abut {

class Store;
struct ClashReport;

struct TopicComment {
    std::string guid, author, text;
    std::int64_t time = 0; ///< seconds since 1970
    std::string viewpoint; ///< GUID of a viewpoint; may be empty
    friend bool operator==(const TopicComment&, const TopicComment&) = default;
};

/// An issue to be settled by people, usually about one group of clashes.
struct Topic {
    /// The identifier. For a group or a clash it is derived from the id (UUID, version 5); of
    /// others as imported.
    std::string guid;
    std::string title, description;
    std::string
        status; ///< any word; "open", "assigned", "resolved", "closed", "approved" are known
    std::string type, priority, stage, assignee;
    std::string due; ///< YYYY-MM-DD; empty: none
    std::vector<std::string> labels, reference_links;
    std::string group;                  ///< id of the group; empty if it is about none
    std::vector<std::uint64_t> clashes; ///< ids
    std::string created_by, modified_by;
    std::int64_t created = 0, modified = 0; ///< seconds since 1970; 0: not stored yet
    std::vector<TopicComment> comments;     ///< by time
    friend bool operator==(const Topic&, const Topic&) = default;
};

/// Returns the GUID of the topic of a group, of a clash.
std::string group_topic_guid(std::string_view group);
std::string clash_topic_guid(std::uint64_t clash);

/// Returns one topic for each innermost group of a report: that of `ClashReport::topics` if there
/// is one, with the clashes that the group has now; else a new one with status "open", which no
/// store has yet. Topics about no group of the report follow.
std::vector<Topic> topics_of_groups(const ClashReport& report);

/// Returns the topics of a store, those with the earliest due date first.
///
/// Errors      those of the store; Error{malformed} if a row is damaged.
std::vector<Topic> read_topics(const Store& store);
/// Returns the topics of a store's groups and clashes, also of resolved ones, as they are before
/// anybody says anything about them: with status "open", and without a date.
///
/// Errors      as read_topics.
std::vector<Topic> untouched_topics(const Store& store);
/// Returns the number of the last change of topics; 0 if there was none.
std::int64_t topics_revision(const Store& store);

struct MergeOptions {
    /// The revision that the edited topics were made from. None: the latest, so that whatever
    /// differs counts as an edit.
    std::optional<std::int64_t> base;
    std::string author;   ///< recorded as who made the changes; empty: `modified_by` of each topic
    std::int64_t now = 0; ///< the time of the change; 0: the clock
};

/// Two people changed one field of a topic. The store keeps its value; the edited value is kept in
/// a comment.
struct TopicConflict {
    std::string guid, title;
    std::string field; ///< "status", "assignee", …; "comment" for the text of a comment
    std::string base, stored, edited;
};

struct TopicMerge {
    std::int64_t revision = 0;               ///< of the store after the merge
    std::vector<std::string> added, changed; ///< GUIDs
    std::uint64_t comments = 0;              ///< new ones
    std::uint64_t marked = 0;                ///< clashes whose mark follows the topic's new status
    std::vector<TopicConflict> conflicts;
    /// Places of a BCF file that other programs may read differently, one line each.
    std::vector<std::string> warnings;
};

/// Merges edited topics into a store, field by field: a field that only the editor has changed
/// since `base` is taken, one that only the store has changed stays, and one that both have changed
/// differently is a conflict. Labels, links and comments are united; one that the editor has
/// removed is removed. Topics that are not named stay. All is done or, after an error, nothing.
///
/// In          store: opened with read_only = false. edited: whole topics; one whose guid is empty
///             is about its group, or about its first clash.
/// Errors      Error{bad_argument}: no guid, group or clash; a guid of a topic or a comment that is
///             not a UUID; a topic given twice; a due date that is none; an unknown base.
///             Error{cannot_write}: the store is read-only.
TopicMerge merge_topics(const Store& store, const std::vector<Topic>& edited,
                        const MergeOptions& options = {});

/// Merges a file of edits, as the report page saves it; docs/topics.md lists the keys. Fields that
/// the file does not name stay as they are.
///
/// Errors      as merge_topics; Error{malformed}, naming the file and the place.
TopicMerge apply_review(const Store& store, const std::string& path,
                        const MergeOptions& options = {});

/// Returns one JSON object; docs/topics.md lists the keys.
std::string to_json(const TopicMerge& merge);

} // namespace abut
