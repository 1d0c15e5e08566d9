#pragma once

#include <abut/clash.h>

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace abut {

/// Reads the values of a settings file and checks them. `where` in a message is a path such as
/// rules[2].a.name.
///
/// Errors      of all members: Error{malformed}, naming the file and the value.
class SettingsReader {
public:
    using Json = nlohmann::json;

    explicit SettingsReader(std::string file) : file_(std::move(file)) {}

    [[noreturn]] void fail(const std::string& where, const std::string& fault) const;
    /// Checks that a value is an object without other keys.
    void require_keys(const Json& value, const std::string& where,
                      std::initializer_list<std::string_view> known) const;
    /// Returns a list with at least one element.
    [[nodiscard]] const Json& read_list(const Json& object, const char* key,
                                        const std::string& what) const;
    [[nodiscard]] std::string read_text(const Json& object, const char* key,
                                        const std::string& where) const;
    /// Returns a text as a list of one, or a list of texts.
    [[nodiscard]] std::vector<std::string> read_texts(const Json& value, const std::string& where,
                                                      const char* what) const;
    [[nodiscard]] bool read_flag(const Json& object, const char* key, bool otherwise,
                                 const std::string& where) const;
    [[nodiscard]] PartQuery read_query(const Json& value, const std::string& where) const;
    /// Reads clearance, touch, tolerate, kinds, severity and ignore into a rule.
    void read_terms(const Json& object, ClashRule& rule, const std::string& where) const;

private:
    [[nodiscard]] std::optional<double> read_length(const Json& object, const char* key,
                                                    const std::string& where) const;
    [[nodiscard]] IgnoreRule read_ignore(const Json& value, const std::string& where) const;
    [[nodiscard]] std::vector<Neighbours> read_neighbours(const Json& value,
                                                          const std::string& where) const;

    std::string file_;
};

} // namespace abut
