#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Names of properties that Abut derives from what a format says in its own way
/// (docs/properties.md). All other properties have names as "SET.NAME": in IFC the property or
/// quantity set, as in "Pset_WallCommon.FireRating"; in glTF "extras.NAME".
///
/// discipline      architecture, structure, plumbing, hvac, electrical, fire, site
/// assembly        the ids of the wholes that the part belongs to, nearest first (IFC: the
///                 GlobalIds of what it is aggregated or nested in); they need not be parts
/// type_object     the name of the type that the part is an occurrence of
/// object_type     what the author calls a type that has no object of its own
inline constexpr std::array<std::string_view, 15> kCommonProperties{
    "storey",      "space",           "building",       "site",     "system",
    "zone",        "group",           "discipline",     "material", "type_object",
    "object_type", "predefined_type", "classification", "tag",      "assembly"};

/// The properties of a scene's parts: pairs of a name and a value, both text (UTF-8). A part may
/// have several values of one name, for example two systems. Numbers have all their digits, in the
/// units of the file.
///
/// Equal texts are stored once. Make one with PropertiesBuilder.
struct Properties {
    struct Entry {
        std::uint32_t name = 0;  ///< index in names
        std::uint32_t value = 0; ///< index in values
        friend bool operator==(const Entry&, const Entry&) = default;
    };
    std::vector<std::string> names;  ///< distinct, ascending
    std::vector<std::string> values; ///< distinct, in the order of their first use
    /// The entries of part i are entries[first[i]] to entries[first[i + 1] - 1]. Empty: no part has
    /// a property.
    std::vector<std::uint64_t> first;
    /// Each part's entries ascend by name. Values of one name have the order of the file.
    std::vector<Entry> entries;

    /// The entries of a part; none for a part that does not exist.
    [[nodiscard]] std::span<const Entry> of(std::uint32_t part) const noexcept;
    /// The part's entries of one name.
    [[nodiscard]] std::span<const Entry> of(std::uint32_t part, std::uint32_t name) const noexcept;
    /// The index of a name; none if no part has such a property.
    [[nodiscard]] std::optional<std::uint32_t> find(std::string_view name) const noexcept;
    /// The first value of that name; empty if the part has none.
    [[nodiscard]] std::string_view value(std::uint32_t part, std::string_view name) const noexcept;

    friend bool operator==(const Properties&, const Properties&) = default;
};

/// Makes Properties part by part.
class PropertiesBuilder {
public:
    PropertiesBuilder();
    PropertiesBuilder(PropertiesBuilder&& other) noexcept;
    PropertiesBuilder& operator=(PropertiesBuilder&& other) noexcept;
    ~PropertiesBuilder();

    /// Adds a property of the current part, which is the first one at the beginning. Does nothing
    /// if the name is empty or the part already has this pair.
    void add(std::string_view name, std::string_view value);
    /// Goes on to the next part.
    void next_part();
    /// Returns the properties of all parts. The builder is empty afterwards.
    ///
    /// In          parts: their number. Parts for which nothing was added have no property.
    [[nodiscard]] Properties finish(std::size_t parts);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// How two parts of one scene belong together.
enum class RelationKind : std::uint8_t {
    fills,     ///< a fills an opening of b: a window or a door, and its wall
    connected, ///< a and b are joined: pipes at their ports, walls along their axes
    covers,    ///< a covers b: insulation and its pipe, a finish and its wall
    part_of,   ///< a is a part of b: both have geometry, and b is the whole
};
/// "fills", "connected", "covers", "part_of".
const char* to_string(RelationKind kind);

struct PartRelation {
    std::uint32_t a = 0, b = 0; ///< indices of parts; connected: a < b
    RelationKind kind = RelationKind::fills;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 of a comparison for a pointer
    friend auto operator<=>(const PartRelation&, const PartRelation&) = default;
};

} // namespace abut
