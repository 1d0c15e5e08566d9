#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

/// What the clash writers share: text that came from files of others, numbers, and the parts of a
/// clash.
namespace abut {

/// Text under construction; fmt::format_to appends to it.
using TextBuffer = fmt::memory_buffer;

inline void append(TextBuffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

/// The text with every ill-formed sequence replaced by U+FFFD, one for each maximal part of a
/// character [Unicode 15, table 3-8].
std::string valid_utf8(std::string_view text);

/// Appends a JSON string in quotes. Ill-formed UTF-8 is replaced. `<` is written as an escape, so
/// that the text may stand in a script element of a page whatever it holds.
void append_json_string(TextBuffer& out, std::string_view text);

/// Appends the shortest decimal that reads back as the same double; `null` if it is not finite,
/// which JSON cannot say otherwise.
void append_json_number(TextBuffer& out, double value);

/// Appends [x,y,z].
void append_json_point(TextBuffer& out, const Vec3& point);

/// None if the text names no kind.
std::optional<ClashKind> clash_kind_of(std::string_view text);

/// Part a (side 0) or b (side 1) of a clash.
/// Errors      Error{bad_argument} if the clash refers to a model or a part that is not there.
const Part& part_of(const Clash& clash, int side, const std::vector<Scene>& models);

/// The members that head a JSON report: `"models": [...], "clearance": .., ... "counts": {...},`.
void append_json_head(TextBuffer& out, const ClashReport& report);
/// The members that end it: `"seconds": {...}, "peak_rss_mb": ..`.
void append_json_tail(TextBuffer& out, const ClashReport& report);

} // namespace abut
