#pragma once

#include <abut/types.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace abut {

/// Returns a whole number without ".0", and null for a value that is not finite, because JSON has no
/// number for it. The text of any other value reads back as the same double.
nlohmann::ordered_json json_number(double value);

/// Returns null for no length.
inline nlohmann::ordered_json json_length(const std::optional<double>& length) {
    return length ? json_number(*length) : nlohmann::ordered_json();
}

/// Returns [x,y,z].
nlohmann::ordered_json json_point(const Vec3& point);

/// Appends a member to an object. The key must be new: unlike operator[], put does not search for it.
inline void put(nlohmann::ordered_json& object, const char* key, nlohmann::ordered_json value) {
    object.get_ref<nlohmann::ordered_json::object_t&>().emplace_back(key, std::move(value));
}

/// Writes JSON that is too large for one nlohmann value: objects member by member and arrays element
/// by element, each on a line of its own, so that line tools can search, compare and cut the text.
///
/// Ill-formed UTF-8 in a value is replaced by U+FFFD. `<` is escaped, so that any text is safe inside
/// a script element of a page.
class JsonLines {
public:
    void begin_object() { open('{'); }
    void end_object() { close('}'); }
    void begin_array() { open('['); }
    void end_array() { close(']'); }

    /// Begins a member of the open object. Its value comes next.
    void key(std::string_view name);
    /// Appends an element of the open array, or the value of the member just begun.
    void value(const nlohmann::ordered_json& json);
    void member(std::string_view name, const nlohmann::ordered_json& json) {
        key(name);
        value(json);
    }
    /// Appends all members of an object.
    void members(const nlohmann::ordered_json& object);

    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    void begin_item();
    void open(char bracket);
    void close(char bracket);
    void append(const nlohmann::ordered_json& json);

    std::string text_;
    bool is_first_ = true;   ///< nothing was written yet into what is open
    bool after_key_ = false; ///< the next value belongs to a member
};

} // namespace abut
