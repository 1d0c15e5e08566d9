#pragma once

#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut {

/// Notes as the JSON text of a model's row: [{"kind": .., "id": .., "name": .., "type": .., "text":
/// ..}]. Bytes that are not UTF-8 are replaced. The text is empty if there are no notes.
std::string note_text(const std::vector<SceneNote>& notes);

/// Errors      Error{malformed}, naming the store, if the text does not have that form.
std::vector<SceneNote> parse_notes(const std::string& text, const std::string& store);

} // namespace abut
