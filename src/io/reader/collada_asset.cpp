#include "io/reader/collada_asset.h"

#include "io/file/fault.h"
#include "io/file/text_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace abut {

namespace {

constexpr std::size_t kBeginning = std::size_t{1} << 20;

bool skip_past(std::string_view& text, std::string_view end) {
    const std::size_t at = text.find(end);
    text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
    return at != std::string_view::npos;
}

/// A start or end tag.
struct Tag {
    std::string_view name;
    std::string_view attributes;
    bool ends = false;        ///< </name>
    bool is_empty = false;    ///< <name/>
    std::string_view content; ///< text up to the next tag
};

/// Takes the next tag; false at the end. Comments and declarations are skipped.
bool next_tag(std::string_view& text, Tag& tag) {
    while (skip_past(text, "<")) {
        if (text.starts_with("!--")) {
            skip_past(text, "-->");
            continue;
        }
        const std::size_t end = text.find('>');
        if (end == std::string_view::npos)
            return false;
        std::string_view inside = text.substr(0, end);
        text.remove_prefix(end + 1);
        if (inside.empty() || inside[0] == '?' || inside[0] == '!')
            continue;
        tag = {};
        tag.ends = inside[0] == '/';
        tag.is_empty = inside.back() == '/';
        if (tag.ends)
            inside.remove_prefix(1);
        const std::size_t name_end = inside.find_first_of(" \t\r\n/");
        tag.name = inside.substr(0, name_end);
        tag.attributes = inside.substr(tag.name.size());
        tag.content = text.substr(0, text.find('<'));
        return true;
    }
    return false;
}

/// Returns the value of an attribute; empty if it is missing.
std::string attribute(std::string_view attributes, std::string_view name) {
    for (std::size_t at = attributes.find(name); at != std::string_view::npos;
         at = attributes.find(name, at + 1)) {
        std::string_view rest = attributes.substr(at + name.size());
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
        if (at == 0 || attributes[at - 1] > ' ' || !rest.starts_with('='))
            continue;
        const std::size_t open = rest.find_first_of("\"'");
        if (open == std::string_view::npos)
            break;
        return std::string(rest.substr(open + 1, rest.find(rest[open], open + 1) - open - 1));
    }
    return {};
}

double metres(const std::string& meter) {
    char* end = nullptr;
    const double unit = std::strtod(meter.c_str(), &end);
    if (!trimmed(end).empty() || !std::isfinite(unit) || unit <= 0)
        malformed("has a unit that is not a positive number of metres: " + meter.substr(0, 40));
    return unit;
}

UpAxis up_axis(std::string_view word) {
    if (word == "X_UP")
        return UpAxis::x;
    if (word == "Z_UP")
        return UpAxis::z;
    if (!word.empty() && word != "Y_UP")
        malformed("has the unknown up_axis " + std::string(word.substr(0, 40)));
    return UpAxis::y;
}

} // namespace

FormatFrame collada_frame(std::string_view text) {
    FormatFrame frame{1, UpAxis::y};
    std::size_t depth = 0;
    bool in_asset = false;
    for (Tag tag; next_tag(text, tag);) {
        if (tag.ends) {
            depth -= depth > 0 ? 1 : 0;
            if (depth == 1 && in_asset)
                break;
            continue;
        }
        if (depth == 1)
            in_asset = tag.name == "asset";
        if (depth == 2 && in_asset && tag.name == "unit") {
            if (const std::string meter = attribute(tag.attributes, "meter"); !meter.empty())
                frame.unit = metres(meter);
        }
        if (depth == 2 && in_asset && tag.name == "up_axis") {
            frame.up = up_axis(trimmed(tag.content));
        }
        depth += tag.is_empty ? 0 : 1;
    }
    return frame;
}

FormatFrame read_collada_frame(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(kBeginning, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return collada_frame(text);
}

} // namespace abut
