#pragma once

#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut {

/// Notes as the JSON text of a model's row: [{"kind": .., "id": .., "name": .., "type": .., "text": ..}];
/// bytes that are no UTF-8 are replaced. Empty for none.
std::string note_text(const std::vector<SceneNote>& notes);

/// Errors      Error{malformed}, naming the store, if the text is not of that kind.
std::vector<SceneNote> parse_notes(const std::string& text, const std::string& store);

} // namespace abut
