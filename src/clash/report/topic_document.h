#pragma once

#include <abut/topics.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace abut {

/// A topic as one line of JSON, with the keys of reports.
std::string document_of(const Topic& topic);
/// Parses such a text. What is missing or of another type stays empty.
Topic topic_of_document(const std::string& document);

/// Sets the fields of a topic that an object names.
///
/// Errors      Error{malformed} without a file, naming the field: an unknown key, a value of the
///             wrong type, or a time, an id or a date that is none.
void read_topic_fields(const nlohmann::json& object, Topic& topic);

/// Returns whether a text is a date: YYYY-MM-DD.
bool is_date(const std::string& text);

} // namespace abut
