#include "clash/report/topic_document.h"

#include <abut/clash.h>
#include <abut/error.h>

#include "clash/report/group_json.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

using nlohmann::json;

[[noreturn]] void refuse_field(const std::string& field, const char* why) {
    throw Error(ErrorCode::malformed, "'" + field + "' " + why);
}

std::string text_field(const std::string& field, const json& value) {
    if (!value.is_string())
        refuse_field(field, "must be a text");
    return value.get<std::string>();
}

std::int64_t time_field(const std::string& field, const json& value) {
    const std::string text = text_field(field, value);
    if (text.empty())
        return 0;
    const auto time = parse_time(text);
    if (!time)
        refuse_field(field, "must be a time such as 2026-11-22T10:00:00Z");
    return *time;
}

std::vector<std::string> texts_field(const std::string& field, const json& value) {
    if (!value.is_array())
        refuse_field(field, "must be a list of texts");
    std::vector<std::string> texts;
    for (const json& text : value)
        texts.push_back(text_field(field, text));
    return texts;
}

TopicComment read_comment(const json& object) {
    if (!object.is_object())
        refuse_field("comments", "must be a list of objects");
    TopicComment comment;
    for (const auto& [key, value] : object.items()) {
        if (key == "guid")
            comment.guid = text_field(key, value);
        else if (key == "author")
            comment.author = text_field(key, value);
        else if (key == "text")
            comment.text = text_field(key, value);
        else if (key == "viewpoint")
            comment.viewpoint = text_field(key, value);
        else if (key == "time")
            comment.time = time_field(key, value);
        else
            refuse_field("comments." + key, "is not a key of a comment");
    }
    return comment;
}

std::string* plain_field(Topic& topic, const std::string& key) {
    const std::pair<const char*, std::string*> fields[]{{"guid", &topic.guid},
                                                        {"group", &topic.group},
                                                        {"title", &topic.title},
                                                        {"description", &topic.description},
                                                        {"status", &topic.status},
                                                        {"type", &topic.type},
                                                        {"priority", &topic.priority},
                                                        {"stage", &topic.stage},
                                                        {"assignee", &topic.assignee},
                                                        {"due", &topic.due},
                                                        {"created_by", &topic.created_by},
                                                        {"modified_by", &topic.modified_by}};
    for (const auto& [name, field] : fields)
        if (key == name)
            return field;
    return nullptr;
}

} // namespace

bool is_date(const std::string& text) {
    constexpr std::size_t kLength = 10;
    return text.size() == kLength && parse_time(text).has_value();
}

void read_topic_fields(const json& object, Topic& topic) {
    for (const auto& [key, value] : object.items()) {
        if (std::string* field = plain_field(topic, key)) {
            *field = text_field(key, value);
            if (key == "due" && !field->empty() && !is_date(*field))
                refuse_field(key, "must be a date such as 2026-11-30");
        } else if (key == "labels") {
            topic.labels = texts_field(key, value);
        } else if (key == "reference_links") {
            topic.reference_links = texts_field(key, value);
        } else if (key == "created") {
            topic.created = time_field(key, value);
        } else if (key == "modified") {
            topic.modified = time_field(key, value);
        } else if (key == "clashes") {
            topic.clashes.clear();
            for (const std::string& text : texts_field(key, value)) {
                const auto id = parse_clash_id(text);
                if (!id)
                    refuse_field(key, "must be a list of clash ids");
                topic.clashes.push_back(*id);
            }
        } else if (key == "comments") {
            if (!value.is_array())
                refuse_field(key, "must be a list of objects");
            topic.comments.clear();
            for (const json& comment : value)
                topic.comments.push_back(read_comment(comment));
        } else {
            refuse_field(key, "is not a key of a topic");
        }
    }
}

std::string document_of(const Topic& topic) {
    return json_of(topic).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Topic topic_of_document(const std::string& document) {
    Topic topic;
    const json object = json::parse(document, nullptr, false);
    if (object.is_object())
        read_topic_fields(object, topic);
    return topic;
}

} // namespace abut
