#include "clash/report/csv_cells.h"

#include "clash/report/clash_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace abut {

namespace {

/// Returns whether a spreadsheet may take the text for a formula or a command. A leading control
/// character suffices, because programs differ in which of them they skip.
bool is_active(std::string_view text) {
    using namespace std::string_view_literals;
    // The second row holds the same characters in full width.
    constexpr std::array kStarts{"="sv,      "+"sv,      "-"sv,      "@"sv,      "|"sv,
                                 "\uFF1D"sv, "\uFF0B"sv, "\uFF0D"sv, "\uFF20"sv, "\uFF5C"sv};
    // Space, no-break, ideographic and zero-width space, byte-order mark.
    constexpr std::array kSpaces{" "sv, "\u00A0"sv, "\u3000"sv, "\u200B"sv, "\uFEFF"sv};
    const auto leads = [&](std::string_view start) { return text.starts_with(start); };
    for (auto space = kSpaces.begin();
         (space = std::ranges::find_if(kSpaces, leads)) != kSpaces.end();)
        text.remove_prefix(space->size());
    const bool control = !text.empty() && static_cast<unsigned char>(text.front()) < 0x20;
    return control || std::ranges::any_of(kStarts, leads);
}

} // namespace

void append_cell(TextBuffer& out, std::string_view raw) {
    const std::string text = valid_utf8(raw);
    const bool formula = is_active(text);
    const bool quoted = text.find_first_of("\",\r\n") != std::string::npos;
    append(out, quoted ? ",\"" : ",");
    if (formula)
        out.push_back('\'');
    for (const char c : text) {
        if (c == '"')
            out.push_back('"');
        out.push_back(c);
    }
    if (quoted)
        out.push_back('"');
}

void append_cell(TextBuffer& out, double value) {
    out.push_back(',');
    if (std::isfinite(value))
        fmt::format_to(fmt::appender(out), "{}", value);
}

void append_rounded_cell(TextBuffer& out, double value, double rounding) {
    if (!std::isfinite(value))
        return append_cell(out, value);
    out.push_back(',');
    append(out, rounded_text(value, rounding));
}

} // namespace abut
