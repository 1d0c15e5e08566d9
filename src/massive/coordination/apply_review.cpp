#include "massive/coordination/apply_review.h"

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/store.h>

#include "clash/report/group_json.h"
#include "clash/report/topic_document.h"

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
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw Error(ErrorCode::file_not_found, path, "cannot be opened");
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

/// The GUID of the topic that an object of the file is about. Removes "clash", which stands for
/// the GUID.
std::string guid_of_entry(json& entry) {
    const auto text = [&](const char* key) {
        const auto found = entry.find(key);
        if (found == entry.end())
            return std::string();
        if (!found->is_string())
            throw Error(ErrorCode::malformed, std::string("'") + key + "' must be a text");
        return found->get<std::string>();
    };
    const std::string guid = text("guid"), group = text("group"), clash = text("clash");
    const auto id = parse_clash_id(clash);
    if (!clash.empty() && !id)
        throw Error(ErrorCode::malformed, "'clash' must be a clash id");
    entry.erase("clash");
    if (!guid.empty())
        return guid;
    if (!group.empty())
        return group_topic_guid(group);
    if (!id)
        throw Error(ErrorCode::malformed, "'guid', 'group' or 'clash' must say what it is about");
    entry["clashes"] = json::array({clash});
    return clash_topic_guid(*id);
}

} // namespace

TopicMerge apply_review(const Store& store, const std::string& path, const MergeOptions& given) {
    json file = read_review_file(path);
    if (!file.is_object() || !file.contains("abut_review"))
        refuse_review(path, "is not a review: 'abut_review' is missing");
    const MergeOptions options = read_head(file, path, given);
    if (!file.contains("topics") || !file["topics"].is_array())
        refuse_review(path, "'topics' must be a list");
    std::vector<Topic> edited;
    for (json& entry : file["topics"]) {
        const std::string where = "topics[" + std::to_string(edited.size()) + "]";
        if (!entry.is_object())
            refuse_review(path, where + " must be an object");
        try {
            const std::string guid = guid_of_entry(entry);
            Topic topic = topic_before_edit(store, guid, options.base);
            // Comments of a file are added: the page saves only the new ones.
            const std::vector<TopicComment> before = std::exchange(topic.comments, {});
            read_topic_fields(entry, topic);
            topic.guid = guid;
            for (const TopicComment& comment : before)
                if (comment.guid.empty() ||
                    std::ranges::find(topic.comments, comment.guid, &TopicComment::guid) ==
                        topic.comments.end())
                    topic.comments.push_back(comment);
            edited.push_back(std::move(topic));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::malformed || !error.file().empty())
                throw;
            refuse_review(path, where + ": " + error.what());
        }
    }
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
                 {"conflicts", conflicts}});
    out.end_object();
    return out.take() + "\n";
}

} // namespace abut
