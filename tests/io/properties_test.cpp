#include <abut/properties.h>

#include "io/scene/property_table.h"
#include "tests/support/random.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace abut {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Properties made_of(const std::vector<Pairs>& parts) {
    PropertiesBuilder builder;
    for (const Pairs& pairs : parts) {
        for (const auto& [name, value] : pairs)
            builder.add(name, value);
        builder.next_part();
    }
    return builder.finish(parts.size());
}

Pairs pairs_of(const Properties& properties, std::uint32_t part) {
    Pairs pairs;
    for (const auto& [name, value] : properties.of(part))
        pairs.emplace_back(properties.names.at(name), properties.values.at(value));
    return pairs;
}

TEST(Properties, HoldsEachPartsPairsByName) {
    const Properties properties = made_of({{{"storey", "L2"}, {"Pset.Fire", "F60"}},
                                           {},
                                           {{"system", "S2"}, {"system", "S1"}, {"storey", "L2"}}});
    EXPECT_EQ(properties.names, (std::vector<std::string>{"Pset.Fire", "storey", "system"}));
    EXPECT_EQ(properties.values, (std::vector<std::string>{"L2", "F60", "S2", "S1"}));
    EXPECT_EQ(pairs_of(properties, 0), (Pairs{{"Pset.Fire", "F60"}, {"storey", "L2"}}));
    EXPECT_TRUE(properties.of(1).empty());
    // Values of one name have the order in which they were added.
    EXPECT_EQ(pairs_of(properties, 2),
              (Pairs{{"storey", "L2"}, {"system", "S2"}, {"system", "S1"}}));
    EXPECT_EQ(properties.value(2, "system"), "S2");
    EXPECT_EQ(properties.of(2, *properties.find("system")).size(), 2u);
    EXPECT_EQ(properties.value(0, "system"), "");
    EXPECT_EQ(properties.value(0, "none"), "");
    EXPECT_FALSE(properties.find("none"));
    EXPECT_TRUE(is_consistent(properties, 3));
    EXPECT_FALSE(is_consistent(properties, 2));
}

TEST(Properties, OfPartsThatDoNotExistAreNone) {
    EXPECT_TRUE(Properties().of(0).empty());
    EXPECT_EQ(Properties().value(0, "storey"), "");
    EXPECT_TRUE(is_consistent(Properties(), 7));
    const Properties properties = made_of({{{"a", "b"}}});
    EXPECT_TRUE(properties.of(1).empty());
    EXPECT_TRUE(properties.of(0xffffffff).empty());
    EXPECT_TRUE(properties.of(0, 7).empty());
}

TEST(Properties, WithoutAnyEntryAreEmpty) {
    EXPECT_EQ(made_of({{}, {}}), Properties());
    EXPECT_EQ(made_of({{{"", "without a name"}}}), Properties());
}

TEST(Properties, RepeatedPairsAreOne) {
    const Properties properties = made_of({{{"b", "1"}, {"a", "1"}, {"b", "2"}, {"b", "1"}}});
    EXPECT_EQ(pairs_of(properties, 0), (Pairs{{"a", "1"}, {"b", "1"}, {"b", "2"}}));
}

TEST(Properties, KeepAnyText) {
    using namespace std::string_literals;
    const std::string longest(1 << 20, 'x');
    const Properties properties =
        made_of({{{"'; DROP TABLE part; --", "\0after"s}, {"n", longest}, {"n", ""}}});
    EXPECT_EQ(properties.value(0, "'; DROP TABLE part; --"), "\0after"s);
    EXPECT_EQ(properties.value(0, "n"), longest);
    EXPECT_EQ(properties.of(0, *properties.find("n")).size(), 2u);
}

TEST(Properties, BuilderFinishesPartsThatWereNotEnded) {
    PropertiesBuilder builder;
    builder.add("a", "1");
    const Properties properties = builder.finish(3);
    EXPECT_EQ(properties.first, (std::vector<std::uint64_t>{0, 1, 1, 1}));
    EXPECT_EQ(builder.finish(2), Properties()) << "the builder is empty afterwards";
}

/// The table equals a map from part and name to the values in order.
TEST(Properties, EqualAMap) {
    test::Random random(20);
    std::size_t repeated = 0, several = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<Pairs> parts(static_cast<std::size_t>(random.integer(0, 6)));
        std::vector<std::map<std::string, std::vector<std::string>>> expected(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (int k = random.integer(0, 12); k > 0; --k) {
                const std::string name(1, static_cast<char>('a' + random.integer(0, 4)));
                const std::string value = std::to_string(random.integer(0, 5));
                parts[i].emplace_back(name, value);
                auto& values = expected[i][name];
                const bool is_known = std::ranges::find(values, value) != values.end();
                repeated += is_known ? 1 : 0;
                if (!is_known)
                    values.push_back(value);
                several += values.size() > 1 ? 1 : 0;
            }
        const Properties properties = made_of(parts);
        EXPECT_TRUE(is_consistent(properties, parts.size()));
        for (std::uint32_t i = 0; i < parts.size(); ++i) {
            Pairs pairs;
            for (const auto& [name, values] : expected[i])
                for (const std::string& value : values)
                    pairs.emplace_back(name, value);
            ASSERT_EQ(pairs_of(properties, i), pairs);
        }
    }
    EXPECT_GT(repeated, 100u);
    EXPECT_GT(several, 100u);
}

TEST(PartRelations, AreSortedAndUnique) {
    std::vector<PartRelation> relations{{3, 1, RelationKind::connected},
                                        {2, 2, RelationKind::covers},
                                        {1, 3, RelationKind::connected},
                                        {3, 1, RelationKind::fills},
                                        {0, 5, RelationKind::part_of}};
    sort_relations(relations);
    EXPECT_EQ(relations, (std::vector<PartRelation>{{0, 5, RelationKind::part_of},
                                                    {1, 3, RelationKind::connected},
                                                    {3, 1, RelationKind::fills}}));
    EXPECT_STREQ(to_string(RelationKind::part_of), "part_of");
}

} // namespace
} // namespace abut
