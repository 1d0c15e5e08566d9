#include "massive/coordination/topic_rows.h"

#include <abut/clash.h>

#include "clash/report/group_json.h"
#include "clash/report/topic_document.h"
#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace abut {

namespace {

constexpr const char* kTopicList = "topic";
constexpr const char* kCommentList = "topic_comment";
constexpr const char* kRevisionList = "topic_revision";

std::uint64_t topic_checksum(const Topic& t, std::int64_t revision) {
    RowHash hash;
    for (const std::string* text :
         {&t.guid, &t.title, &t.description, &t.status, &t.type, &t.priority, &t.stage, &t.assignee,
          &t.due, &t.group, &t.created_by, &t.modified_by})
        hash.add(*text);
    for (const auto* texts : {&t.labels, &t.reference_links}) {
        hash.add(std::uint64_t{texts->size()});
        for (const std::string& text : *texts)
            hash.add(text);
    }
    hash.add(std::uint64_t{t.clashes.size()});
    for (const std::uint64_t clash : t.clashes)
        hash.add(clash);
    return hash.add(t.created).add(t.modified).add(revision).value();
}

std::uint64_t comment_checksum(const std::string& topic, const TopicComment& c) {
    RowHash hash;
    for (const std::string* text : {&topic, &c.guid, &c.author, &c.text, &c.viewpoint})
        hash.add(*text);
    return hash.add(c.time).value();
}

std::uint64_t revision_checksum(std::int64_t revision, const std::string& guid,
                                const std::string& document) {
    return RowHash().add(revision).add(guid).add(document).value();
}

/// Adds the difference of two checksums to a tally that the store has.
void change_tally(Database& database, const char* list, std::optional<std::uint64_t> before,
                  std::optional<std::uint64_t> after) {
    RowTally tally = read_tally(database, list);
    if (before)
        tally.remove(*before);
    if (after)
        tally.add(*after);
    write_tally(database, list, tally);
}

std::vector<std::string> texts_of(const std::string& list) {
    std::vector<std::string> texts;
    const auto parsed = nlohmann::json::parse(list, nullptr, false);
    if (parsed.is_array())
        for (const auto& text : parsed)
            if (text.is_string())
                texts.push_back(text.get<std::string>());
    return texts;
}

std::string json_text(const std::vector<std::string>& texts) {
    return nlohmann::json(texts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string clashes_text(const std::vector<std::uint64_t>& clashes) {
    std::vector<std::string> texts;
    texts.reserve(clashes.size());
    for (const std::uint64_t clash : clashes)
        texts.push_back(clash_id_text(clash));
    return json_text(texts);
}

std::vector<std::uint64_t> clashes_of_text(const std::string& list) {
    std::vector<std::uint64_t> clashes;
    for (const std::string& text : texts_of(list))
        if (const auto id = parse_clash_id(text))
            clashes.push_back(*id);
    return clashes;
}

struct StoredTopic {
    Topic topic;
    std::int64_t revision = 0;
};

/// Topics by GUID, without comments.
std::map<std::string, StoredTopic> read_plain_topics(Database& database) {
    std::map<std::string, StoredTopic> result;
    RowTally tally;
    Statement rows(database,
                   "SELECT guid, title, description, status, type, priority, stage, assignee, "
                   "due, labels, reference_links, clash_group, clashes, created, created_by, "
                   "modified, modified_by, revision, checksum FROM topic");
    while (rows.step()) {
        StoredTopic row;
        Topic& t = row.topic;
        int column = 0;
        for (std::string* text : {&t.guid, &t.title, &t.description, &t.status, &t.type,
                                  &t.priority, &t.stage, &t.assignee, &t.due})
            *text = rows.text(column++);
        t.labels = texts_of(rows.text(9));
        t.reference_links = texts_of(rows.text(10));
        t.group = rows.text(11);
        t.clashes = clashes_of_text(rows.text(12));
        t.created = rows.integer(13);
        t.created_by = rows.text(14);
        t.modified = rows.integer(15);
        t.modified_by = rows.text(16);
        row.revision = rows.integer(17);
        const auto checksum = static_cast<std::uint64_t>(rows.integer(18));
        if (topic_checksum(t, row.revision) != checksum)
            damaged_job(database, "topic " + t.guid + " does not match its checksum");
        tally.add(checksum);
        const std::string guid = t.guid;
        result.emplace(guid, std::move(row));
    }
    require_tally(database, kTopicList, tally);
    return result;
}

void read_comments(Database& database, std::map<std::string, StoredTopic>& topics) {
    RowTally tally;
    Statement rows(database, "SELECT topic, guid, author, text, time, viewpoint, checksum FROM "
                             "topic_comment ORDER BY topic, time, guid");
    while (rows.step()) {
        TopicComment comment{rows.text(1), rows.text(2), rows.text(3), rows.integer(4),
                             rows.text(5)};
        const auto checksum = static_cast<std::uint64_t>(rows.integer(6));
        const auto topic = topics.find(rows.text(0));
        if (topic == topics.end() || comment_checksum(rows.text(0), comment) != checksum)
            damaged_job(database, "comment " + comment.guid + " does not match its checksum");
        tally.add(checksum);
        topic->second.topic.comments.push_back(std::move(comment));
    }
    require_tally(database, kCommentList, tally);
}

std::map<std::string, StoredTopic> read_stored_topics(Database& database) {
    auto topics = read_plain_topics(database);
    read_comments(database, topics);
    return topics;
}

void write_comments(Database& database, const Topic* before, const Topic& topic) {
    std::map<std::string, std::uint64_t> old;
    if (before != nullptr)
        for (const TopicComment& comment : before->comments)
            old.emplace(comment.guid, comment_checksum(topic.guid, comment));
    for (const TopicComment& comment : topic.comments) {
        const std::uint64_t checksum = comment_checksum(topic.guid, comment);
        const auto known = old.find(comment.guid);
        const bool is_known = known != old.end();
        if (!is_known || known->second != checksum) {
            Statement(database, "INSERT OR REPLACE INTO topic_comment VALUES (?,?,?,?,?,?,?)")
                .bind(topic.guid, comment.guid, comment.author, comment.text, comment.time,
                      comment.viewpoint, checksum)
                .run();
            change_tally(database, kCommentList,
                         is_known ? std::optional(known->second) : std::nullopt, checksum);
        }
        if (is_known)
            old.erase(known);
    }
    for (const auto& [guid, checksum] : old) {
        Statement(database, "DELETE FROM topic_comment WHERE topic = ? AND guid = ?")
            .bind(topic.guid, guid)
            .run();
        change_tally(database, kCommentList, checksum, std::nullopt);
    }
}

} // namespace

std::int64_t last_revision(Database& database) {
    return database.number("SELECT coalesce(max(revision), 0) FROM topic_revision");
}

std::vector<Topic> read_topic_rows(Database& database) {
    std::vector<Topic> topics;
    for (auto& [guid, row] : read_stored_topics(database))
        topics.push_back(std::move(row.topic));
    std::ranges::sort(topics, {}, [](const Topic& t) {
        return std::tuple(t.due.empty(), t.due, t.created, t.guid);
    });
    return topics;
}

std::optional<Topic> topic_at_revision(Database& database, const std::string& guid,
                                       std::int64_t revision) {
    Statement row(database, "SELECT revision, document, checksum FROM topic_revision WHERE "
                            "guid = ? AND revision <= ? ORDER BY revision DESC LIMIT 1");
    row.bind(guid, revision);
    if (!row.step())
        return std::nullopt;
    const std::string document = row.text(1);
    if (revision_checksum(row.integer(0), guid, document) !=
        static_cast<std::uint64_t>(row.integer(2)))
        damaged_job(database, "a revision of topic " + guid + " does not match its checksum");
    return topic_of_document(document);
}

void write_topic(Database& database, const Topic* before, const Topic& topic,
                 std::int64_t revision) {
    std::optional<std::uint64_t> old;
    if (before != nullptr) {
        Statement row(database, "SELECT checksum FROM topic WHERE guid = ?");
        if (row.bind(topic.guid).step())
            old = static_cast<std::uint64_t>(row.integer(0));
    }
    const std::uint64_t checksum = topic_checksum(topic, revision);
    const std::string labels = json_text(topic.labels), links = json_text(topic.reference_links),
                      clashes = clashes_text(topic.clashes);
    Statement(database, "INSERT OR REPLACE INTO topic VALUES "
                        "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(topic.guid, topic.title, topic.description, topic.status, topic.type, topic.priority,
              topic.stage, topic.assignee, topic.due, labels, links, topic.group, clashes,
              topic.created, topic.created_by, topic.modified, topic.modified_by, revision,
              checksum)
        .run();
    change_tally(database, kTopicList, old, checksum);
    write_comments(database, before, topic);
    const std::string document = document_of(topic);
    const std::uint64_t sum = revision_checksum(revision, topic.guid, document);
    Statement(database, "INSERT INTO topic_revision VALUES (?,?,?,?)")
        .bind(revision, topic.guid, document, sum)
        .run();
    change_tally(database, kRevisionList, std::nullopt, sum);
}

void verify_topics(Database& database) {
    (void)read_stored_topics(database);
    RowTally tally;
    Statement rows(database, "SELECT revision, guid, document, checksum FROM topic_revision");
    while (rows.step()) {
        const auto checksum = static_cast<std::uint64_t>(rows.integer(3));
        if (revision_checksum(rows.integer(0), rows.text(1), rows.text(2)) != checksum)
            damaged_job(database,
                        "a revision of topic " + rows.text(1) + " does not match its checksum");
        tally.add(checksum);
    }
    require_tally(database, kRevisionList, tally);
}

} // namespace abut
