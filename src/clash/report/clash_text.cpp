#include "clash/report/clash_text.h"

#include <abut/error.h>

#include "clash/report/clash_status_text.h"

#include <charconv>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Utf8Sequence {
    std::size_t length; ///< bytes of the character, or of the ill-formed part to replace
    bool valid;
};

/// Examines the character that begins at `text[0]`, which is not ASCII.
Utf8Sequence utf8_sequence(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    // The range of the second byte excludes overlong forms, surrogates and values above U+10FFFF.
    unsigned lower = 0x80;
    unsigned upper = 0xBF;
    std::size_t length = 0;
    if (lead >= 0xC2 && lead <= 0xDF) {
        length = 2;
    } else if (lead >= 0xE0 && lead <= 0xEF) {
        length = 3;
        lower = lead == 0xE0 ? 0xA0 : lower;
        upper = lead == 0xED ? 0x9F : upper;
    } else if (lead >= 0xF0 && lead <= 0xF4) {
        length = 4;
        lower = lead == 0xF0 ? 0x90 : lower;
        upper = lead == 0xF4 ? 0x8F : upper;
    } else {
        return {1, false};
    }
    for (std::size_t i = 1; i < length; ++i) {
        if (i >= text.size() || byte(i) < lower || byte(i) > upper)
            return {i, false};
        lower = 0x80;
        upper = 0xBF;
    }
    return {length, true};
}

void append_json_ascii(TextBuffer& out, char c) {
    switch (c) {
    case '"':
        return append(out, "\\\"");
    case '\\':
        return append(out, "\\\\");
    case '\n':
        return append(out, "\\n");
    case '\r':
        return append(out, "\\r");
    case '\t':
        return append(out, "\\t");
    default:
        if (static_cast<unsigned char>(c) < 0x20 || c == '<' || c == 0x7F)
            fmt::format_to(fmt::appender(out), "\\u{:04x}", static_cast<unsigned>(c));
        else
            out.push_back(c);
    }
}

/// Appends `, "notes": [...]` if there are notes.
void append_json_notes(TextBuffer& out, const std::vector<SceneNote>& notes) {
    if (notes.empty())
        return;
    append(out, ", \"notes\": [");
    const char* separator = "\n    ";
    for (const SceneNote& note : notes) {
        append(out, separator);
        fmt::format_to(fmt::appender(out), "{{\"kind\": \"{}\", \"id\": ", to_string(note.kind));
        append_json_string(out, note.id);
        append(out, ", \"name\": ");
        append_json_string(out, note.name);
        append(out, ", \"type\": ");
        append_json_string(out, note.type);
        append(out, ", \"text\": ");
        append_json_string(out, note.text);
        append(out, "}");
        separator = ",\n    ";
    }
    append(out, "]");
}

} // namespace

std::string valid_utf8(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        Utf8Sequence next{1, true};
        if (static_cast<unsigned char>(text[0]) >= 0x80)
            next = utf8_sequence(text);
        out += next.valid ? text.substr(0, next.length) : kReplacement;
        text.remove_prefix(next.length);
    }
    return out;
}

void append_json_string(TextBuffer& out, std::string_view text) {
    out.push_back('"');
    while (!text.empty()) {
        Utf8Sequence next{1, true};
        if (static_cast<unsigned char>(text[0]) < 0x80) {
            append_json_ascii(out, text[0]);
        } else {
            next = utf8_sequence(text);
            append(out, next.valid ? text.substr(0, next.length) : kReplacement);
        }
        text.remove_prefix(next.length);
    }
    out.push_back('"');
}

void append_json_number(TextBuffer& out, double value) {
    if (!std::isfinite(value))
        append(out, "null");
    else if (value == 0 && std::signbit(value))
        append(out, "-0.0"); // readers take "-0" for an integer, which has no sign
    else
        fmt::format_to(fmt::appender(out), "{}", value);
}

void append_json_point(TextBuffer& out, const Vec3& point) {
    out.push_back('[');
    append_json_number(out, point.x);
    out.push_back(',');
    append_json_number(out, point.y);
    out.push_back(',');
    append_json_number(out, point.z);
    out.push_back(']');
}

std::string clash_id_text(std::uint64_t id) {
    return fmt::format("{:016x}",
                       id); // text, because not every reader preserves a JSON number of 64 bits
}

std::optional<std::uint64_t> parse_clash_id(std::string_view text) {
    std::uint64_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
    if (error != std::errc() || end != text.data() + text.size() || clash_id_text(id) != text)
        return std::nullopt;
    return id;
}

std::optional<ClashKind> clash_kind_of(std::string_view text) {
    for (const ClashKind kind : kClashKinds)
        if (text == to_string(kind))
            return kind;
    return std::nullopt;
}

const Part& part_of(const Clash& clash, int side, const std::vector<Scene>& models) {
    const auto s = static_cast<std::size_t>(side);
    if (clash.model[s] >= models.size() || clash.part[s] >= models[clash.model[s]].parts.size())
        throw Error(
            ErrorCode::bad_argument,
            fmt::format("clash {} refers to part {} of model {}, which is not among the models",
                        clash_id_text(clash.id), clash.part[s], clash.model[s]));
    return models[clash.model[s]].parts[clash.part[s]];
}

void append_json_head(TextBuffer& out, const ClashReport& report) {
    append(out, "\"models\": [");
    const char* separator = "\n";
    for (const ClashReport::ModelSummary& model : report.models) {
        append(out, separator);
        append(out, "  {\"file\": ");
        append_json_string(out, model.file);
        fmt::format_to(fmt::appender(out),
                       ", \"parts\": {}, \"triangles\": {}, \"unit\": ", model.parts,
                       model.triangles);
        append_json_number(out, model.unit);
        fmt::format_to(fmt::appender(out), ", \"up\": \"{}\"", to_string(model.up));
        append_json_notes(out, model.notes);
        append(out, "}");
        separator = ",\n";
    }
    fmt::format_to(
        fmt::appender(out),
        "\n],\n\"frame\": {{\"up\": \"{}\", \"unit\": \"m\", \"of\": ", to_string(report.frame.up));
    append_json_string(out, report.frame.of);
    append(out, "},\n\"warnings\": [");
    separator = "";
    for (const std::string& warning : report.warnings) {
        append(out, separator);
        append_json_string(out, warning);
        separator = ", ";
    }
    append(out, "],\n\"clearance\": ");
    append_json_number(out, report.clearance);
    append(out, ",\n\"touch\": ");
    append_json_number(out, report.touch_tolerance);
    fmt::format_to(fmt::appender(out), ",\n\"candidates\": {},\n\"counts\": {{", report.candidates);
    separator = "";
    for (const ClashKind kind : kClashKinds) {
        fmt::format_to(fmt::appender(out), "{}\"{}\": {}", separator, to_string(kind),
                       report.counts[static_cast<std::size_t>(kind)]);
        separator = ", ";
    }
    append(out, "},\n");
    if (!report.statuses)
        return;
    append(out, "\"statuses\": ");
    append_json_statuses(out, *report.statuses);
    append(out, ",\n");
}

void append_json_tail(TextBuffer& out, const ClashReport& report) {
    const ClashReport::Seconds& seconds = report.seconds;
    append(out, "\"seconds\": {\"import\": ");
    append_json_number(out, seconds.import);
    append(out, ", \"build\": ");
    append_json_number(out, seconds.build);
    append(out, ", \"broad\": ");
    append_json_number(out, seconds.broad);
    append(out, ", \"narrow\": ");
    append_json_number(out, seconds.narrow);
    append(out, ", \"total\": ");
    append_json_number(out, seconds.total);
    append(out, "},\n\"peak_rss_mib\": ");
    append_json_number(out, report.peak_rss_mib);
    append(out, "\n");
}

} // namespace abut
