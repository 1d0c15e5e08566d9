#include <abut/clash.h>

#include "clash/rules/settings_file.h"
#include "clash/rules/settings_reader.h"

namespace abut {

namespace {

using Json = nlohmann::json;

PartSelector read_selector(const SettingsReader& reader, const Json& rule, const char* side,
                           const std::string& where) {
    PartSelector selector;
    if (!rule.contains(side))
        return selector;
    const Json& value = rule[side];
    const std::string here = where + "." + side;
    if (value.is_string()) {
        selector.query = reader.read_query(value, here);
        return selector;
    }
    if (!value.is_object())
        reader.fail(here, "must be a condition in a text, or an object");
    reader.require_keys(value, here, {"file", "name", "type"});
    const auto read_globs = [&](const char* key) {
        return value.contains(key) ? reader.read_texts(value[key], here + "." + key, "glob")
                                   : std::vector<std::string>();
    };
    selector.file = read_globs("file");
    selector.name = read_globs("name");
    selector.type = read_globs("type");
    return selector;
}

ClashRule read_rule(const SettingsReader& reader, const Json& value, const std::string& where) {
    reader.require_keys(
        value, where,
        {"name", "a", "b", "clearance", "touch", "tolerate", "kinds", "severity", "ignore"});
    ClashRule rule;
    rule.name = reader.read_text(value, "name", where);
    rule.a = read_selector(reader, value, "a", where);
    rule.b = read_selector(reader, value, "b", where);
    reader.read_terms(value, rule, where);
    return rule;
}

} // namespace

std::vector<ClashRule> read_rules(const std::string& path) {
    const SettingsReader reader(path);
    const Json root = read_settings(path);
    reader.require_keys(root, "the file", {"$schema", "rules"});
    std::vector<ClashRule> rules;
    for (const Json& value : reader.read_list(root, "rules", "rule"))
        rules.push_back(read_rule(reader, value, "rules[" + std::to_string(rules.size()) + "]"));
    return rules;
}

} // namespace abut
