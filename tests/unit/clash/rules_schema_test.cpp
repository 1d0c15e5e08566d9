// The readers of rules and matrices against the schemas that are shipped: both accept the same
// files, but for what a schema cannot say.

#include <abut/clash.h>
#include <abut/error.h>

#include "tests/support/folder.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace abut::test {
namespace {

using nlohmann::json;

json read_schema(const std::string& name) {
    return json::parse(std::ifstream(std::string(ABUT_SOURCE_DIR) + "/docs/schema/" + name));
}

bool has_type(const json& value, const std::string& type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "integer" ? value.is_number_integer()
                               : type == "number" && value.is_number();
}

/// Validates with the keywords that the two schemas use; an unknown one is a failure.
bool is_valid(const json& schema, const json& value) {
    const auto is_one = [&](const json& other) { return is_valid(other, value); };
    for (const auto& [key, rule] : schema.items()) {
        bool good = true;
        if (key == "type")
            good = has_type(value, rule);
        else if (key == "enum")
            good = std::ranges::find(rule, value) != rule.end();
        else if (key == "anyOf")
            good = std::ranges::any_of(rule, is_one);
        else if (key == "minimum")
            good = !value.is_number() || value.get<double>() >= rule.get<double>();
        else if (key == "minItems")
            good = !value.is_array() || value.size() >= rule.get<std::size_t>();
        else if (key == "maxItems")
            good = !value.is_array() || value.size() <= rule.get<std::size_t>();
        else if (key == "items")
            good = !value.is_array() || std::ranges::all_of(value, [&](const json& element) {
                return is_valid(rule, element);
            });
        else if (key == "required")
            good = !value.is_object() || std::ranges::all_of(rule, [&](const json& name) {
                return value.contains(name.get<std::string>());
            });
        else if (key == "properties" && value.is_object()) {
            for (const auto& [name, member] : value.items())
                good = good && (rule.contains(name) ? is_valid(rule[name], member)
                                                    : schema.value("additionalProperties", true));
        } else if (key != "properties" && key != "additionalProperties" && key != "title" &&
                   key != "description" && key != "$schema")
            ADD_FAILURE() << "unknown keyword " << key;
        if (!good)
            return false;
    }
    return true;
}

template <typename Read>
bool is_read(const Folder& folder, const json& file, const Read& read) {
    const std::string path = folder / "file.json";
    std::ofstream(path) << file;
    try {
        (void)read(path);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::malformed);
        return false;
    }
}

/// Values to put in place of others.
std::vector<json> other_values() {
    return {nullptr,
            true,
            false,
            0,
            -1,
            0.5,
            "hard",
            "",
            "type = x",
            "*",
            "services",
            "fills",
            "covers",
            json::array(),
            json::object(),
            json::array({"hard"}),
            json::array({"fills", "covers"}),
            json::array({1}),
            json::array({"services"}),
            json{{"type", "x"}},
            json{{"odd", 1}}};
}

/// Replaces each value of the file by others, adds unknown keys and removes keys; calls
/// take(changed file).
template <typename Take>
void for_each_change(const json& file, const Take& take) {
    const json flat = file.flatten();
    std::vector<std::string> places;
    for (const auto& [place, unused] : flat.items())
        for (std::string at = place; !at.empty(); at = at.substr(0, at.rfind('/')))
            if (std::ranges::find(places, at) == places.end())
                places.push_back(at);
    for (const std::string& place : places) {
        const json::json_pointer at(place);
        for (const json& value : other_values()) {
            json changed = file;
            changed[at] = value;
            take(changed);
        }
        json changed = file;
        if (changed[at.parent_pointer()].is_object()) {
            changed[at.parent_pointer()].erase(at.back());
            take(changed);
            changed = file;
            changed[at.parent_pointer()]["odd"] = 1;
            take(changed);
        }
    }
}

template <typename Read>
void compare(const char* schema_name, const json& file, const Read& read) {
    const json schema = read_schema(schema_name);
    const Folder folder;
    ASSERT_TRUE(is_valid(schema, file));
    ASSERT_TRUE(is_read(folder, file, read));
    int accepted = 0, refused = 0, stricter = 0;
    for_each_change(file, [&](const json& changed) {
        const bool valid = is_valid(schema, changed), good = is_read(folder, changed, read);
        // A schema knows neither the language of conditions nor the names of groups.
        stricter += valid && !good ? 1 : 0;
        EXPECT_TRUE(valid || !good) << "read, but not valid: " << changed;
        ++(good ? accepted : refused);
    });
    EXPECT_GT(accepted, 20);
    EXPECT_GT(refused, 100);
    EXPECT_LT(stricter, refused / 2);
}

TEST(RulesSchema, AgreesWithTheReader) {
    const json rule{{"name", "pipes"},
                    {"a", "type = IfcPipe*"},
                    {"b", {{"type", {"IfcBeam", "x"}}, {"file", "*s*"}, {"name", "n"}}},
                    {"clearance", 0.1},
                    {"touch", 0},
                    {"tolerate", 0.01},
                    {"kinds", {"hard", "contained"}},
                    {"severity", "high"},
                    {"ignore",
                     {{"same_file", true},
                      {"same_type", false},
                      {"same_name_prefix", 3},
                      {"neighbours", {"fills", "connected"}}}}};
    compare("clash-rules.schema.json", {{"rules", {rule, {{"name", "rest"}}}}}, read_rules);
}

TEST(MatrixSchema, AgreesWithTheReader) {
    const json cell{{"a", "services"},
                    {"b", {"structure", "services"}},
                    {"on", true},
                    {"clearance", 0.1},
                    {"kinds", "hard"},
                    {"severity", "low"},
                    {"tolerate", 0.01},
                    {"touch", 0.001},
                    {"ignore", {{"neighbours", true}}}};
    compare("clash-matrix.schema.json",
            {{"groups",
              {{{"name", "services"}, {"select", "discipline = hvac"}},
               {{"name", "structure"}, {"select", "discipline = structure"}}}},
             {"cells", {cell, {{"a", "*"}, {"b", "*"}, {"on", false}}}}},
            read_matrix);
}

} // namespace
} // namespace abut::test
