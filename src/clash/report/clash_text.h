#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

/// Shared code of the clash report writers: untrusted text, numbers, and the parts of a clash.
namespace abut {

/// Text under construction; fmt::format_to appends to it.
using TextBuffer = fmt::memory_buffer;

inline void append(TextBuffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

/// Returns the text with every ill-formed sequence replaced by U+FFFD, one for each maximal subpart
/// of a character [Unicode 15, table 3-8].
std::string valid_utf8(std::string_view text);

/// Appends a JSON string in quotes. Ill-formed UTF-8 is replaced. `<` is escaped, so that any text
/// is safe inside a script element of a page.
void append_json_string(TextBuffer& out, std::string_view text);

/// Appends the shortest decimal that reads back as the same double. A value that is not finite
/// becomes `null`, because JSON has no number for it.
void append_json_number(TextBuffer& out, double value);

/// Appends [x,y,z].
void append_json_point(TextBuffer& out, const Vec3& point);

/// Returns the kind of that name; none if the text names no kind.
std::optional<ClashKind> clash_kind_of(std::string_view text);

/// Returns part a (side 0) or b (side 1) of a clash.
/// Errors      Error{bad_argument} if the clash refers to a model or a part that does not exist.
const Part& part_of(const Clash& clash, int side, const std::vector<Scene>& models);

/// Appends the first members of a JSON report:
/// `"models": [...], "clearance": .., ... "counts": {...},`.
void append_json_head(TextBuffer& out, const ClashReport& report);
/// Appends the last members of a JSON report: `"seconds": {...}, "peak_rss_mib": ..`.
void append_json_tail(TextBuffer& out, const ClashReport& report);

} // namespace abut
