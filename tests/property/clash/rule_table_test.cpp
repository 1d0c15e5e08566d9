// The rule table against a direct implementation of the rules' definition.

#include <abut/error.h>

#include "clash/query/glob.h"
#include "clash/rules/rule_table.h"
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
    [[nodiscard]] PartFacts subject() const { return {model, file, id, name, type}; }
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

/// A part of the tests below, with properties.
struct KnownPart {
    std::string type, storey, assembly;
};

/// Adds parts of one model to a table.
void add_all(RuleTable& table, const std::vector<KnownPart>& parts, Properties& properties) {
    PropertiesBuilder builder;
    for (const KnownPart& part : parts) {
        for (const auto& [name, value] :
             {std::pair<std::string, std::string>{"storey", part.storey},
              {"assembly", part.assembly}})
            if (!value.empty())
                builder.add(name, value);
        builder.next_part();
    }
    properties = builder.finish(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        table.add({0, "a.ifc", "id", "name", parts[i].type, &properties, i});
}

TEST(RuleTable, OnlyAAndBSelectPairs) {
    ClashOptions options;
    options.only = PartQuery::parse("storey = L1");
    options.a = PartQuery::parse("type = Pipe");
    options.b = PartQuery::parse("type = Beam or type = Pipe and tag = 7");
    RuleTable table(options);
    Properties properties;
    add_all(table, {{"Pipe", "L1", ""}, {"Beam", "L1", ""}, {"Pipe", "L1", ""}, {"Beam", "L2", ""}},
            properties);
    EXPECT_TRUE(table.terms(0, 1) && table.terms(1, 2));
    EXPECT_FALSE(table.terms(0, 2));
    EXPECT_FALSE(table.terms(0, 3));
    EXPECT_EQ(table.decide(0, 3).reason, LeftOut::not_selected);
    EXPECT_TRUE(table.warnings().empty()); // these tell of rules and groups
    try {
        table.require_known([] { return std::vector<std::string>{"bag", "storey"}; });
        FAIL() << "no part has a tag";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("--b: no part has the property \"tag\"; the nearest are bag"),
                  std::string::npos)
            << error.what();
    }
}

TEST(RuleTable, AMatrixDecidesWhereNoRuleDoes) {
    ClashOptions options;
    options.clearance = 0.5;
    options.matrix.groups = {{"pipes", PartQuery::parse("type = Pipe")},
                             {"rest", PartQuery::parse("id = *")}};
    options.matrix.cells.resize(2);
    options.matrix.cells[0] = {0, 1, true, {"pipes / rest", {}, {}, 0.1, 0.2, {}}};
    options.matrix.cells[0].terms.kinds = {ClashKind::hard, ClashKind::clearance};
    options.matrix.cells[1] = {1, 1, false, {"rest / rest", {}, {}, {}, {}, {}}};
    ClashRule rule;
    rule.name = "valves", rule.a.query = PartQuery::parse("type = Valve");
    rule.b.query = PartQuery::parse("type = Pipe"), rule.clearance = 0.7;
    options.rules = {rule};
    RuleTable table(options);
    Properties properties;
    add_all(
        table,
        {{"Pipe", "", ""}, {"Pipe", "", ""}, {"Wall", "", ""}, {"Wall", "", ""}, {"Valve", "", ""}},
        properties);
    const auto crossing = table.terms(2, 0), valve = table.terms(0, 4);
    ASSERT_TRUE(crossing && valve);
    EXPECT_EQ(crossing->rule->name, "pipes / rest");
    EXPECT_EQ(crossing->clearance, 0.1);
    EXPECT_EQ(crossing->touch, 0.2);
    EXPECT_EQ(crossing->kinds, 0b10001);
    EXPECT_EQ(valve->rule->name, "valves");
    EXPECT_EQ(valve->clearance, 0.7);
    EXPECT_EQ(table.decide(2, 3).reason, LeftOut::off);
    EXPECT_EQ(table.decide(0, 1).reason, LeftOut::not_selected);
}

TEST(RuleTable, KnownNeighboursAreNamedOrLeftOut) {
    ClashOptions options;
    options.leave_out = {Neighbours::fills};
    RuleTable table(options);
    Properties properties;
    add_all(table,
            {{"Window", "", ""},
             {"Wall", "", ""},
             {"Pipe", "", "S"},
             {"Pipe", "", "S"},
             {"Pipe", "", "T"}},
            properties);
    const std::vector<PartRelation> relations{{0, 1, RelationKind::fills},
                                              {2, 4, RelationKind::connected},
                                              {1, 4, RelationKind::part_of}};
    table.add(relations, 0);
    EXPECT_EQ(table.decide(1, 0).reason, LeftOut::fills);
    EXPECT_FALSE(table.terms(0, 1));
    EXPECT_EQ(table.terms(2, 3)->neighbours, Neighbours::same_assembly);
    EXPECT_EQ(table.terms(4, 2)->neighbours, Neighbours::connected);
    EXPECT_EQ(table.terms(4, 1)->neighbours, Neighbours::same_assembly);
    EXPECT_EQ(table.terms(3, 4)->neighbours, std::nullopt);
}

} // namespace
} // namespace abut::test
