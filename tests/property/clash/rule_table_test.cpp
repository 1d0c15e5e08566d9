// The rule table against a direct implementation of the rules' definition.

#include "clash/rule_table.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <string>

namespace abut::test {
namespace {

struct NamedPart {
    std::uint32_t model;
    std::string file, id, name, type;
    [[nodiscard]] RuleSubject subject() const { return {model, file, id, name, type}; }
};

bool matches(const std::vector<std::string>& globs, const std::string& text) {
    return std::ranges::any_of(globs, [&](const std::string& g) { return glob_match(g, text); });
}

bool selects(const PartSelector& side, const NamedPart& part) {
    const std::string file = part.file.substr(part.file.rfind('/') + 1);
    return (side.file.empty() || matches(side.file, part.file) || matches(side.file, file)) &&
           (side.name.empty() || matches(side.name, part.name) || matches(side.name, part.id)) &&
           (side.type.empty() || matches(side.type, part.type));
}

/// Index of the first rule that selects the pair; -1 if none does, -2 if that rule ignores the
/// pair.
int deciding(const std::vector<ClashRule>& rules, const NamedPart& a, const NamedPart& b) {
    for (std::size_t r = 0; r < rules.size(); ++r) {
        const ClashRule& rule = rules[r];
        if (!(selects(rule.a, a) && selects(rule.b, b)) &&
            !(selects(rule.a, b) && selects(rule.b, a)))
            continue;
        const std::size_t n = rule.ignore.same_name_prefix;
        const bool ignored = (rule.ignore.same_file && a.model == b.model) ||
                             (rule.ignore.same_type && a.type == b.type) ||
                             (n > 0 && a.name.size() >= n && b.name.size() >= n &&
                              a.name.substr(0, n) == b.name.substr(0, n));
        return ignored ? -2 : static_cast<int>(r);
    }
    return -1;
}

template <std::size_t count>
std::string any_of(Random& random, const std::array<const char*, count>& words) {
    return words.at(static_cast<std::size_t>(random.integer(0, count - 1)));
}

std::vector<std::string> globs(Random& random) {
    std::vector<std::string> result;
    while (random.chance(0.4))
        result.push_back(
            any_of(random, std::array{"*", "a*", "*b", "?b*", "ab", "", "hall/*", "*c?"}));
    return result;
}

TEST(RuleTable, AgreesWithTheDefinitionOfTheRules) {
    Random random(6301);
    std::array<int, 3> seen{}; // a rule, none, ignored
    for (int round = 0; round < many(300); ++round) {
        ClashOptions options;
        for (int i = random.integer(1, 4); i > 0; --i) {
            ClashRule rule;
            rule.a = {globs(random), globs(random), globs(random)};
            rule.b = {globs(random), globs(random), globs(random)};
            rule.ignore = {random.chance(0.2), random.chance(0.2),
                           random.chance(0.4) ? static_cast<std::size_t>(random.integer(1, 3)) : 0};
            if (random.chance(0.5))
                rule.clearance = random.uniform(0, 1);
            options.rules.push_back(rule);
        }
        options.clearance = 2, options.touch_tolerance = 3;
        RuleTable table(options);
        std::vector<NamedPart> parts;
        for (int i = 0; i < 12; ++i) {
            const int model = random.integer(0, 2);
            parts.push_back({static_cast<std::uint32_t>(model),
                             std::array{"hall/ab", "abc", "hall/abc"}.at(model),
                             any_of(random, std::array{"a", "bb", "abc1", ""}),
                             any_of(random, std::array{"", "a", "ab", "abcd", "abce", "b"}),
                             any_of(random, std::array{"", "ab", "abc", "b"})});
            table.add(parts.back().subject());
        }
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (std::size_t k = 0; k < parts.size(); ++k) {
                const int rule = deciding(options.rules, parts[i], parts[k]);
                const auto terms = table.terms(i, k);
                ++seen.at(rule >= 0 ? 0 : static_cast<std::size_t>(-rule));
                ASSERT_EQ(terms.has_value(), rule >= 0) << "round " << round;
                if (!terms)
                    continue;
                EXPECT_EQ(terms->rule, &options.rules[static_cast<std::size_t>(rule)]);
                EXPECT_EQ(terms->clearance, terms->rule->clearance.value_or(2));
                EXPECT_EQ(terms->touch, 3);
            }
    }
    for (const int count : seen)
        EXPECT_GT(count, many(300) * 144 / 20);
}

TEST(RuleTable, WithoutRulesAllPairsUseTheOptions) {
    ClashOptions options;
    options.clearance = 0.5, options.touch_tolerance = 0.25;
    RuleTable table(options);
    table.add({}), table.add({});
    const auto terms = table.terms(0, 1);
    ASSERT_TRUE(terms);
    EXPECT_EQ(terms->clearance, 0.5);
    EXPECT_EQ(terms->touch, 0.25);
    EXPECT_EQ(terms->rule, nullptr);
}

} // namespace
} // namespace abut::test
