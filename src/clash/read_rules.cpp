#include <abut/clash.h>
#include <abut/error.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

namespace abut {

namespace {

using Json = nlohmann::json;

/// Reads one rules file. `where` in a message is a path like rules[2].a.name.
class RulesReader {
public:
    explicit RulesReader(const std::string& path) : path_(path) {}

    std::vector<ClashRule> read() {
        std::ifstream in(path_);
        if (!in)
            throw Error(ErrorCode::file_not_found, path_, "cannot be opened");
        std::ostringstream text;
        text << in.rdbuf();
        if (in.bad())
            throw Error(ErrorCode::unreadable, path_, "cannot be read");
        Json root;
        try {
            root = Json::parse(text.str());
        } catch (const Json::parse_error& error) {
            throw Error(ErrorCode::malformed, path_,
                        "is not JSON (near byte " + std::to_string(error.byte) + ")");
        } catch (const Json::out_of_range&) {
            throw Error(ErrorCode::malformed, path_, "has a number that no double holds");
        }
        require_keys(root, "the file", {"rules"});
        if (!root.contains("rules") || !root["rules"].is_array() || root["rules"].empty())
            fail("rules", "must be a list of at least one rule");
        std::vector<ClashRule> rules;
        for (std::size_t i = 0; i < root["rules"].size(); ++i)
            rules.push_back(read_rule(root["rules"][i], "rules[" + std::to_string(i) + "]"));
        return rules;
    }

private:
    [[noreturn]] void fail(const std::string& where, const std::string& fault) const {
        throw Error(ErrorCode::malformed, path_, where + " " + fault);
    }

    void require_keys(const Json& value, const std::string& where,
                      std::initializer_list<std::string_view> known) const {
        if (!value.is_object())
            fail(where, "must be an object");
        for (const auto& [key, unused] : value.items())
            if (std::find(known.begin(), known.end(), key) == known.end())
                fail(where, "has an unknown key \"" + key + "\"");
    }

    ClashRule read_rule(const Json& value, const std::string& where) const {
        require_keys(value, where, {"name", "a", "b", "clearance", "touch", "ignore"});
        ClashRule rule;
        if (!value.contains("name") || !value["name"].is_string())
            fail(where + ".name", "must be a text");
        rule.name = value["name"].get<std::string>();
        rule.a = read_selector(value, "a", where);
        rule.b = read_selector(value, "b", where);
        rule.clearance = read_length(value, "clearance", where);
        rule.touch_tolerance = read_length(value, "touch", where);
        if (value.contains("ignore"))
            rule.ignore = read_ignore(value["ignore"], where + ".ignore");
        return rule;
    }

    PartSelector read_selector(const Json& rule, const char* side, const std::string& where) const {
        PartSelector selector;
        if (!rule.contains(side))
            return selector;
        const Json& value = rule[side];
        const std::string here = where + "." + side;
        require_keys(value, here, {"file", "name", "type"});
        selector.file = read_globs(value, "file", here);
        selector.name = read_globs(value, "name", here);
        selector.type = read_globs(value, "type", here);
        return selector;
    }

    std::vector<std::string> read_globs(const Json& selector, const char* key,
                                        const std::string& where) const {
        if (!selector.contains(key))
            return {};
        const Json& value = selector[key];
        if (value.is_string())
            return {value.get<std::string>()};
        const auto is_text = [](const Json& v) { return v.is_string(); };
        if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), is_text))
            fail(where + "." + key, "must be a glob or a list of globs");
        return value.get<std::vector<std::string>>();
    }

    std::optional<double> read_length(const Json& rule, const char* key,
                                      const std::string& where) const {
        if (!rule.contains(key))
            return std::nullopt;
        if (!rule[key].is_number() || !(rule[key].get<double>() >= 0) ||
            !std::isfinite(rule[key].get<double>()))
            fail(where + "." + key, "must be a length in metres, not negative");
        return rule[key].get<double>();
    }

    IgnoreRule read_ignore(const Json& value, const std::string& where) const {
        require_keys(value, where, {"same_file", "same_type", "same_name_prefix"});
        IgnoreRule ignore;
        const auto read_flag = [&](const char* key) {
            if (!value.contains(key))
                return false;
            if (!value[key].is_boolean())
                fail(where + "." + key, "must be true or false");
            return value[key].get<bool>();
        };
        ignore.same_file = read_flag("same_file");
        ignore.same_type = read_flag("same_type");
        if (value.contains("same_name_prefix")) {
            if (!value["same_name_prefix"].is_number_unsigned())
                fail(where + ".same_name_prefix", "must be a number of characters");
            ignore.same_name_prefix = value["same_name_prefix"].get<std::size_t>();
        }
        return ignore;
    }

    const std::string& path_;
};

} // namespace

std::vector<ClashRule> read_rules(const std::string& path) {
    return RulesReader(path).read();
}

} // namespace abut
