#include "massive/coordination/apply_review.h"

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/store.h>

#include "clash/report/group_json.h"
#include "clash/report/topic_document.h"
#include "core/uuid.h"
#include "io/file/text_stream.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

namespace abut {

namespace {

using nlohmann::json;

[[noreturn]] void refuse_review(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::malformed, path, why);
}

json read_review_file(const std::string& path) {
    std::ifstream in = open_text(path);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        refuse_review(path, std::string("is not JSON: ") + error.what());
    }
}

/// The keys of a file of edits beside "topics".
MergeOptions read_head(const json& file, const std::string& path, MergeOptions options) {
    for (const auto& [key, value] : file.items()) {
        if (key == "abut_review") {
            if (value != 1)
                refuse_review(path, "is of another version: 'abut_review' must be 1");
        } else if (key == "revision") {
            if (!value.is_number_integer())
                refuse_review(path, "'revision' must be a whole number");
            if (!options.base)
                options.base = value.get<std::int64_t>();
        } else if (key == "author") {
            if (!value.is_string())
                refuse_review(path, "'author' must be a text");
            if (options.author.empty())
                options.author = value.get<std::string>();
        } else if (key != "store" && key != "job" && key != "saved" && key != "topics") {
            refuse_review(path, "'" + key + "' is not a key of a review");
        }
    }
    return options;
}

void require_uuid(const std::string& guid, const std::string& place) {
    if (!guid.empty() && !is_uuid(guid))
        throw Error(ErrorCode::malformed,
                    place + " must be a UUID such as 01234567-89ab-4cde-8f01-23456789abcd, not '" +
                        guid + "'");
}

/// The GUID of the topic that an object of the file is about. Removes "clash", which stands for
/// the GUID.
std::string guid_of_entry(json& entry) {
    if (!entry.is_object())
        throw Error(ErrorCode::malformed, "is not an object");
    const auto text = [&](const char* key) {
        const auto found = entry.find(key);
        if (found == entry.end())
            return std::string();
        if (!found->is_string())
            throw Error(ErrorCode::malformed, std::string("'") + key + "' must be a text");
        return found->get<std::string>();
    };
    std::string guid = text("guid");
    const std::string group = text("group"), clash = text("clash");
    const auto id = parse_clash_id(clash);
    if (!clash.empty() && !id)
        throw Error(ErrorCode::malformed, "'clash' must be a clash id");
    if (!group.empty() && !parse_clash_id(group))
        throw Error(ErrorCode::malformed,
                    "'group' must be the id of a group: 16 hexadecimal digits");
    require_uuid(guid, "'guid'");
    entry.erase("clash");
    if (!guid.empty())
        return lower_uuid(std::move(guid));
    if (!group.empty())
        return group_topic_guid(group);
    if (!id)
        throw Error(ErrorCode::malformed, "'guid', 'group' or 'clash' must say what it is about");
    entry["clashes"] = json::array({clash});
    return clash_topic_guid(*id);
}

/// Sets the fields that an object of the file has. Its comments are added: the page saves only the
/// new ones.
void edit_topic(const json& entry, Topic& topic) {
    const std::string guid = topic.guid;
    const std::vector<TopicComment> before = std::exchange(topic.comments, {});
    topic.modified_by.clear(); // not who changed it before
    read_topic_fields(entry, topic);
    topic.guid = guid;
    for (std::size_t i = 0; i < topic.comments.size(); ++i) {
        TopicComment& comment = topic.comments[i];
        const std::string place = "comments[" + std::to_string(i) + "]: ";
        require_uuid(comment.guid, place + "'guid'");
        require_uuid(comment.viewpoint, place + "'viewpoint'");
        comment.guid = lower_uuid(std::move(comment.guid));
    }
    for (const TopicComment& comment : before)
        if (comment.guid.empty() || std::ranges::find(topic.comments, comment.guid,
                                                      &TopicComment::guid) == topic.comments.end())
            topic.comments.push_back(comment);
}

/// Runs work(), and adds the file and the place to its errors that name no file.
template <typename Work>
void at_entry(const std::string& path, std::size_t entry, const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::malformed || !error.file().empty())
            throw;
        refuse_review(path, "topics[" + std::to_string(entry) + "]: " + error.what());
    }
}

} // namespace

TopicMerge apply_review(const Store& store, const std::string& path, const MergeOptions& given) {
    json file = read_review_file(path);
    if (!file.is_object() || !file.contains("abut_review"))
        refuse_review(path, "is not a review: 'abut_review' is missing");
    MergeOptions options = read_head(file, path, given);
    if (!file.contains("topics") || !file["topics"].is_array())
        refuse_review(path, "'topics' must be a list");
    json& entries = file["topics"];
    std::vector<std::string> guids;
    for (json& entry : entries)
        at_entry(path, guids.size(), [&] { guids.push_back(guid_of_entry(entry)); });
    // Named, so that what others change from here on is not taken back.
    const std::int64_t base = options.base.value_or(topics_revision(store));
    options.base = base;
    std::vector<Topic> edited = topics_before_edit(store, guids, base);
    for (std::size_t i = 0; i < edited.size(); ++i)
        at_entry(path, i, [&] { edit_topic(entries[i], edited[i]); });
    return merge_topics(store, edited, options);
}

std::string to_json(const TopicMerge& merge) {
    nlohmann::ordered_json conflicts = nlohmann::ordered_json::array();
    for (const TopicConflict& c : merge.conflicts)
        conflicts.push_back({{"guid", c.guid},
                             {"title", c.title},
                             {"field", c.field},
                             {"base", c.base},
                             {"stored", c.stored},
                             {"edited", c.edited}});
    JsonLines out;
    out.begin_object();
    out.members({{"revision", merge.revision},
                 {"added", merge.added},
                 {"changed", merge.changed},
                 {"comments", merge.comments},
                 {"marked", merge.marked},
                 {"conflicts", conflicts},
                 {"warnings", merge.warnings}});
    out.end_object();
    return out.take() + "\n";
}

} // namespace abut
