#include <abut/clash.h>
#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store.h>
#include <abut/topics.h>

#include "clash/groups/group_topics.h"
#include "clash/report/group_json.h"
#include "clash/report/topic_document.h"
#include "core/uuid.h"
#include "massive/coordination/apply_review.h"
#include "massive/coordination/coordination_tables.h"
#include "massive/coordination/topic_marks.h"
#include "massive/coordination/topic_merge.h"
#include "massive/coordination/topic_rows.h"
#include "massive/record/job_tables.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace abut {

namespace {

[[noreturn]] void refuse_topic(const std::string& topic, const std::string& why) {
    throw Error(ErrorCode::bad_argument, "topic " + topic + " " + why);
}

std::string guid_of(const Topic& topic) {
    if (!topic.guid.empty())
        return topic.guid;
    if (!topic.group.empty())
        return group_topic_guid(topic.group);
    if (!topic.clashes.empty())
        return clash_topic_guid(topic.clashes.front());
    throw Error(ErrorCode::bad_argument, "a topic has neither a GUID, nor a group, nor a clash");
}

/// The topics of all groups that the store knows, by GUID, as if nobody had said anything of them.
std::map<std::string, Topic> topics_nobody_touched(Database& database) {
    std::map<std::string, Topic> topics;
    Statement rows(database, "SELECT id, path, name, what FROM clash_group ORDER BY question DESC");
    while (rows.step()) {
        Topic topic = fresh_topic(rows.text(0), rows.text(2), rows.text(3));
        const std::string guid = topic.guid;
        topics.insert_or_assign(guid, std::move(topic));
    }
    return topics;
}

/// Makes the GUIDs of a topic and its comments lower case.
///
/// Errors      Error{bad_argument} if one is not a UUID.
void take_guids(Topic& topic) {
    const auto take = [&](std::string& guid, const char* of) {
        if (!guid.empty() && !is_uuid(guid))
            refuse_topic(topic.guid, fmt::format("has {} '{}', which is not a UUID", of, guid));
        guid = lower_uuid(std::move(guid));
    };
    take(topic.guid, "the GUID");
    for (TopicComment& comment : topic.comments) {
        take(comment.guid, "a comment with the GUID");
        take(comment.viewpoint, "a comment on the viewpoint");
    }
}

/// The topic with U+FFFD in place of bytes that are not UTF-8, as its revisions have it.
Topic as_kept(Topic topic) {
    Topic kept = topic_of_document(document_of(topic));
    kept.guid = std::move(topic.guid);
    kept.comments = std::move(topic.comments);
    return kept;
}

/// Merges topics one by one within a transaction.
class Merger {
public:
    Merger(Database& database, const MergeOptions& options)
        : database_(database), options_(options),
          now_(options.now != 0 ? options.now : abut::now()), marks_(database),
          fresh_(topics_nobody_touched(database)) {
        for (Topic& topic : read_topic_rows(database)) {
            const std::string guid = topic.guid;
            stored_.emplace(guid, std::move(topic));
        }
        const std::int64_t last = last_revision(database);
        if (options.base && (*options.base < 0 || *options.base > last))
            throw Error(ErrorCode::bad_argument, database.path(),
                        fmt::format("has no revision {}; its last one is {}", *options.base, last));
        result_.revision = last;
    }

    void merge(Topic edited) {
        edited.guid = guid_of(edited);
        take_guids(edited);
        if (!seen_.insert(edited.guid).second)
            refuse_topic(edited.guid, "is given twice");
        if (!edited.due.empty() && !is_date(edited.due))
            refuse_topic(edited.guid, "has a due date that is none: YYYY-MM-DD is asked for");
        const auto known = stored_.find(edited.guid);
        const auto fresh = fresh_.find(edited.guid);
        Topic before;
        before.guid = edited.guid;
        if (known != stored_.end())
            before = known->second;
        else if (fresh != fresh_.end())
            before = fresh->second;
        complete_comments(edited);
        const std::size_t conflicts = result_.conflicts.size();
        Topic merged = merge_topic(base_of(before), before, edited, result_.conflicts);
        keep_what_lost(merged, conflicts, author_of(edited));
        write(known != stored_.end() ? &before : nullptr, before, std::move(merged), edited);
    }

    TopicMerge finish() { return std::move(result_); }

private:
    Topic base_of(const Topic& stored) const {
        if (!options_.base)
            return stored;
        if (auto at = topic_at_revision(database_, stored.guid, *options_.base))
            return *std::move(at);
        // The editor saw the topic before anyone had touched it.
        const auto fresh = fresh_.find(stored.guid);
        if (fresh != fresh_.end())
            return fresh->second;
        Topic empty;
        empty.guid = stored.guid;
        return empty;
    }

    std::string author_of(const Topic& edited) const {
        return options_.author.empty() ? edited.modified_by : options_.author;
    }

    /// Gives comments without a GUID, an author or a time what they lack.
    void complete_comments(Topic& edited) const {
        for (TopicComment& comment : edited.comments) {
            if (comment.author.empty())
                comment.author = author_of(edited);
            if (comment.time == 0)
                comment.time = now_;
            if (comment.guid.empty())
                comment.guid =
                    uuid_of_name(edited.guid, comment.author + "\n" + time_text(comment.time) +
                                                  "\n" + comment.text);
        }
    }

    /// Adds a comment with the edited value of each conflict since `first`.
    void keep_what_lost(Topic& merged, std::size_t first, const std::string& author) const {
        for (std::size_t i = first; i < result_.conflicts.size(); ++i) {
            const TopicConflict& conflict = result_.conflicts[i];
            TopicComment comment;
            comment.author = author;
            comment.time = now_;
            comment.text = fmt::format("Conflict: {} stays \"{}\"; not taken: \"{}\"",
                                       conflict.field, conflict.stored, conflict.edited);
            comment.guid = uuid_of_name(merged.guid, comment.text + time_text(now_));
            if (std::ranges::find(merged.comments, comment.guid, &TopicComment::guid) ==
                merged.comments.end())
                merged.comments.push_back(comment);
        }
    }

    void write(const Topic* stored, const Topic& before, Topic merged, const Topic& edited) {
        if (merged == before && (stored != nullptr || !merged.group.empty()))
            return;
        const bool is_change = result_.added.empty() && result_.changed.empty();
        if (is_change)
            ++result_.revision;
        if (stored == nullptr) {
            merged.created = edited.created != 0 ? edited.created : now_;
            merged.created_by = edited.created_by.empty() ? author_of(edited) : edited.created_by;
        }
        merged.modified = now_;
        merged.modified_by = author_of(edited);
        merged = as_kept(std::move(merged));
        (stored == nullptr ? result_.added : result_.changed).push_back(merged.guid);
        for (const TopicComment& comment : merged.comments)
            if (std::ranges::find(before.comments, comment.guid, &TopicComment::guid) ==
                before.comments.end())
                ++result_.comments;
        write_topic(database_, stored, merged, result_.revision);
        result_.marked += marks_.change(before, merged, now_);
    }

    Database& database_;
    const MergeOptions& options_;
    std::int64_t now_;
    TopicMarks marks_;
    std::map<std::string, Topic> stored_, fresh_;
    std::set<std::string> seen_;
    TopicMerge result_;
};

/// The topics that a file's edits refer to, as they were when the edits were made.
std::vector<Topic> edited_at(Database& database, const std::vector<std::string>& guids,
                             std::int64_t base) {
    const std::map<std::string, Topic> fresh = topics_nobody_touched(database);
    std::vector<Topic> topics;
    topics.reserve(guids.size());
    for (const std::string& guid : guids) {
        const auto found = fresh.find(guid);
        Topic& topic = topics.emplace_back(found != fresh.end() ? found->second : Topic());
        if (auto at = topic_at_revision(database, guid, base))
            topic = *std::move(at);
        topic.guid = guid;
    }
    return topics;
}

} // namespace

std::vector<Topic> read_topics(const Store& store) {
    return store.file().with_connection([](Database& database) {
        return has_coordination_tables(database) ? read_topic_rows(database) : std::vector<Topic>();
    });
}

std::vector<Topic> untouched_topics(const Store& store) {
    auto topics = store.file().with_connection([](Database& database) {
        return has_coordination_tables(database) ? topics_nobody_touched(database)
                                                 : std::map<std::string, Topic>();
    });
    for (const ClashReview& review : review_clashes(store))
        for (const ListedClash& clash : review.clashes) {
            const auto name = [&](std::size_t side) {
                return clash.name.at(side).empty() ? clash.part.at(side) : clash.name.at(side);
            };
            Topic topic = fresh_topic_of_clash(clash.id, name(0), name(1));
            const std::string guid = topic.guid;
            topics.emplace(guid, std::move(topic));
        }
    std::vector<Topic> result;
    result.reserve(topics.size());
    for (auto& [guid, topic] : topics)
        result.push_back(std::move(topic));
    return result;
}

std::int64_t topics_revision(const Store& store) {
    return store.file().with_connection([](Database& database) {
        return has_coordination_tables(database) ? last_revision(database) : std::int64_t{0};
    });
}

TopicMerge merge_topics(const Store& store, const std::vector<Topic>& edited,
                        const MergeOptions& options) {
    return store.file().with_connection([&](Database& database) {
        Transaction transaction(database);
        prepare_coordination_tables(database);
        Merger merger(database, options);
        for (const Topic& topic : edited)
            merger.merge(topic);
        transaction.commit();
        return merger.finish();
    });
}

std::vector<Topic> topics_before_edit(const Store& store, const std::vector<std::string>& guids,
                                      std::int64_t base) {
    return store.file().with_connection([&](Database& database) {
        if (has_coordination_tables(database))
            return edited_at(database, guids, base);
        std::vector<Topic> topics(guids.size());
        for (std::size_t i = 0; i < guids.size(); ++i)
            topics[i].guid = guids[i];
        return topics;
    });
}

} // namespace abut
