#include "io/reader/threemf.h"

#include "io/file/fault.h"
#include "io/reader/zip_archive.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
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

/// A start tag: its local name and the rest of its text.
struct Tag {
    std::string_view name, attributes;
};

/// The start tags of an XML text; comments are skipped. An end tag comes with an empty name.
class Tags {
public:
    explicit Tags(std::string_view text) : rest_(text) {}

    /// Takes the next tag; false if there are none left.
    bool next(Tag& tag) {
        while (true) {
            const std::size_t open = rest_.find('<');
            if (open == std::string_view::npos)
                return false;
            rest_.remove_prefix(open);
            const bool is_comment = rest_.starts_with("<!--");
            const std::size_t close = is_comment ? rest_.find("-->") : rest_.find('>');
            if (close == std::string_view::npos)
                return false;
            const std::string_view text = rest_.substr(1, close - 1);
            rest_.remove_prefix(close + 1);
            if (is_comment)
                continue;
            std::size_t end = 0;
            while (end < text.size() && !is_blank(text[end]) && text[end] != '/')
                ++end;
            tag = {text.substr(0, end), text.substr(end)};
            tag.name.remove_prefix(std::min(tag.name.find(':') + 1, tag.name.size()));
            return true;
        }
    }

private:
    std::string_view rest_;
};

/// Returns an attribute's value; empty if it is missing.
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
    for (Tag tag; tags.next(tag);)
        if (tag.name == "Relationship" && attribute(tag.attributes, "Type") == kModelType) {
            std::string_view target = attribute(tag.attributes, "Target");
            target.remove_prefix(target.starts_with('/') ? 1 : 0);
            return std::string(target);
        }
    malformed("names no model among its relationships");
}

/// Counts the parts that a model builds, before anything is built, because nested components
/// multiply exponentially.
class PartCount {
public:
    /// In          tag: the model's tags, in order.
    /// Errors      Fault malformed for an object that is used before it is defined, and for too
    ///             many parts.
    void take(const Tag& tag) {
        if (tag.name == "object")
            current_ = &parts_[attribute(tag.attributes, "id")];
        else if (tag.name == "mesh" && current_ != nullptr)
            *current_ = sum(*current_, 1);
        else if (tag.name == "component" && current_ != nullptr)
            *current_ = sum(*current_, of_object(tag.attributes));
        else if (tag.name == "build")
            current_ = nullptr;
        else if (tag.name == "item")
            build(of_object(tag.attributes));
    }

private:
    static constexpr std::uint64_t kMost = 10'000'000;

    void build(std::uint64_t parts) {
        built_ = sum(built_, parts);
        if (built_ > kMost)
            malformed("builds more than " + std::to_string(kMost) + " parts");
    }

    /// The sum, capped at kMost + 1, because an object that is never built may have any count.
    static std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
        return std::min(a + b, kMost + 1);
    }

    /// Parts of an object. An object of another model in the archive (`path`) counts as one part.
    std::uint64_t of_object(std::string_view attributes) const {
        const std::string_view id = attribute(attributes, "objectid");
        const auto found = parts_.find(id);
        if (found != parts_.end() && &found->second != current_)
            return found->second;
        if (attributes.find("path") != std::string_view::npos)
            return 1;
        malformed("refers to object " + std::string(id.substr(0, 40)) + " before it is defined");
    }

    std::map<std::string_view, std::uint64_t> parts_; ///< by an object's id
    std::uint64_t* current_ = nullptr;
    std::uint64_t built_ = 0;
};

} // namespace

ThreemfModel read_3mf_model(const std::string& file) {
    const ZipArchive archive(file);
    const std::string text = archive.content(model_entry(archive));
    Tags tags(text);
    Tag tag;
    while (tags.next(tag) && tag.name != "model")
        ;
    if (tag.name != "model")
        malformed("holds no model");
    const std::string_view word = attribute(tag.attributes, "unit");
    ThreemfModel result;
    result.frame = {0.001, UpAxis::z};
    if (!word.empty()) {
        const auto* const unit = std::find_if(kUnits.begin(), kUnits.end(),
                                              [&](const auto& u) { return u.first == word; });
        if (unit == kUnits.end())
            malformed("has the unknown unit " + std::string(word.substr(0, 40)));
        result.frame.unit = unit->second;
    }
    PartCount count;
    std::string_view object;
    while (tags.next(tag)) {
        count.take(tag);
        if (tag.name == "object")
            object = attribute(tag.attributes, "id");
        if ((tag.name == "object" || tag.name == "triangle") &&
            !attribute(tag.attributes, "pid").empty())
            result.with_material.emplace(object);
        if (tag.name == "object")
            if (const std::string_view name = attribute(tag.attributes, "name"); !name.empty())
                result.names.emplace(attribute(tag.attributes, "id"), without_entities(name));
    }
    return result;
}

} // namespace abut
