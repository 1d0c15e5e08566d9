#include "store/import/note_text.h"

#include <abut/error.h>

#include <array>
#include <nlohmann/json.hpp>

namespace abut {

namespace {

constexpr std::array kKinds{NoteKind::space, NoteKind::cut_away, NoteKind::not_built,
                            NoteKind::open};

NoteKind kind_of(const std::string& word, const std::string& store) {
    for (const NoteKind kind : kKinds)
        if (word == to_string(kind))
            return kind;
    throw Error(ErrorCode::malformed, store, "is damaged: it has a note of an unknown kind");
}

} // namespace

std::string note_text(const std::vector<SceneNote>& notes) {
    if (notes.empty())
        return {};
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SceneNote& note : notes)
        rows.push_back({{"kind", to_string(note.kind)},
                        {"id", note.id},
                        {"name", note.name},
                        {"type", note.type},
                        {"text", note.text}});
    return rows.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::vector<SceneNote> parse_notes(const std::string& text, const std::string& store) {
    std::vector<SceneNote> notes;
    if (text.empty())
        return notes;
    try {
        for (const nlohmann::json& row : nlohmann::json::parse(text))
            notes.push_back({kind_of(row.at("kind"), store), row.at("id"), row.at("name"),
                             row.at("type"), row.at("text")});
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::malformed, store, "is damaged: the notes of a model are not JSON");
    }
    return notes;
}

} // namespace abut
