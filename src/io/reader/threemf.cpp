#include "io/reader/threemf.h"

#include "io/fault.h"
#include "io/reader/zip_archive.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace abut {

namespace {

constexpr std::string_view kModelType =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// Metres per unit [3MF Core 1.3, 3.4, ST_Unit].
constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{{{"micron", 1e-6},
                                                                     {"millimeter", 0.001},
                                                                     {"centimeter", 0.01},
                                                                     {"inch", 0.0254},
                                                                     {"foot", 0.3048},
                                                                     {"meter", 1}}};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// The start tags of an XML text with a local name; comments are passed over.
class Tags {
public:
    explicit Tags(std::string_view text) : rest_(text) {}

    /// The next start tag of this name, from behind the name to its end; empty if there is none.
    std::string_view next(std::string_view name) {
        while (true) {
            const std::size_t open = rest_.find('<');
            if (open == std::string_view::npos)
                return {};
            rest_.remove_prefix(open);
            const bool is_comment = rest_.starts_with("<!--");
            const std::size_t close = is_comment ? rest_.find("-->") : rest_.find('>');
            if (close == std::string_view::npos)
                return {};
            const std::string_view tag = rest_.substr(1, close - 1);
            rest_.remove_prefix(close + 1);
            std::size_t end = 0;
            while (end < tag.size() && !is_blank(tag[end]) && tag[end] != '/')
                ++end;
            std::string_view found = tag.substr(0, end);
            found.remove_prefix(std::min(found.find(':') + 1, found.size()));
            if (!is_comment && found == name)
                return tag.substr(end).empty() ? std::string_view(" ") : tag.substr(end);
        }
    }

private:
    std::string_view rest_;
};

/// An attribute's value; empty if there is none.
std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != std::string_view::npos;
         at = tag.find(name, at + 1)) {
        if (at == 0 || !is_blank(tag[at - 1]))
            continue;
        std::size_t from = at + name.size();
        while (from < tag.size() && (is_blank(tag[from]) || tag[from] == '='))
            ++from;
        if (from == tag.size() || (tag[from] != '"' && tag[from] != '\''))
            continue;
        const std::size_t end = tag.find(tag[from], from + 1);
        if (end != std::string_view::npos)
            return tag.substr(from + 1, end - from - 1);
    }
    return {};
}

std::string without_entities(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
    std::string result;
    while (!text.empty()) {
        char c = text.front();
        std::size_t length = 1;
        for (const auto& [entity, character] : kEntities)
            if (text.starts_with(entity)) {
                c = character;
                length = entity.size();
                break;
            }
        result += c;
        text.remove_prefix(length);
    }
    return result;
}

std::string model_entry(const ZipArchive& archive) {
    const std::string relations = archive.content("_rels/.rels");
    Tags tags(relations);
    for (std::string_view tag = tags.next("Relationship"); !tag.empty();
         tag = tags.next("Relationship"))
        if (attribute(tag, "Type") == kModelType) {
            std::string_view target = attribute(tag, "Target");
            target.remove_prefix(target.starts_with('/') ? 1 : 0);
            return std::string(target);
        }
    malformed("names no model among its relationships");
}

} // namespace

ThreemfModel read_3mf_model(const std::string& file) {
    const ZipArchive archive(file);
    const std::string text = archive.content(model_entry(archive));
    const std::string_view model = Tags(text).next("model");
    if (model.empty())
        malformed("holds no model");
    const std::string_view word = attribute(model, "unit");
    ThreemfModel result;
    result.frame = {0.001, UpAxis::z};
    if (!word.empty()) {
        const auto* const unit = std::find_if(kUnits.begin(), kUnits.end(),
                                              [&](const auto& u) { return u.first == word; });
        if (unit == kUnits.end())
            malformed("has the unknown unit " + std::string(word.substr(0, 40)));
        result.frame.unit = unit->second;
    }
    Tags tags(text);
    for (std::string_view tag = tags.next("object"); !tag.empty(); tag = tags.next("object"))
        if (const std::string_view name = attribute(tag, "name"); !name.empty())
            result.names.emplace(attribute(tag, "id"), without_entities(name));
    return result;
}

} // namespace abut
