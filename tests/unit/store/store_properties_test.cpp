/// Properties of parts in a store: what is kept, what counts as a change, what is noticed as damage.
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "store/database/property_table.h"
#include "store/database/store_file.h"
#include "tests/support/folder.h"
#include "tests/support/store/page_queries.h"

#include <gtest/gtest.h>
#include <utility>

namespace abut::test {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

class StoreProperties : public testing::Test {
protected:
    /// Three boxes, the first two of which touch. Their properties are these.
    ImportReport import(const std::vector<Pairs>& parts, const std::string& name = "a.glb") {
        Scene scene;
        scene.meshes = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}};
        PropertiesBuilder properties;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double x = i == 2 ? 10 : 0.25 * static_cast<double>(i);
            scene.parts.push_back(
                {"part " + std::to_string(i), "", "Solid", 0, Pose{.translation = {x, 0, 0}}});
            for (const auto& [property, value] : parts[i])
                properties.add(property, value);
            properties.next_part();
        }
        scene.properties = properties.finish(parts.size());
        const std::string file = folder_ / name;
        write_glb(scene, file);
        return import_models({file}, store_);
    }
    [[nodiscard]] Pairs pairs(const Scene& scene, std::uint32_t part) const {
        Pairs result;
        for (const auto& [name, value] : scene.properties.of(part))
            result.emplace_back(scene.properties.names[name], scene.properties.values[value]);
        return result;
    }
    std::int64_t number(const char* sql) {
        Database database(store_, OpenMode::read_write);
        return database.number(sql);
    }
    void change(const char* sql) {
        Database database(store_, OpenMode::read_write);
        database.run(sql);
    }
    void expect_damage() {
        try {
            verify(open_store(store_));
            ADD_FAILURE() << "no damage was found";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::malformed) << error.what();
        }
    }
    Folder folder_;
    std::string store_ = folder_ / "s.abut";
};

const std::vector<Pairs> kParts{{{"Pset_X.Fire", "F60"}, {"storey", "L1"}},
                                {{"storey", "L2"}, {"system", "B"}, {"system", "A"}},
                                {}};

TEST_F(StoreProperties, ComeBackAsTheyWere) {
    using namespace std::string_literals;
    const std::vector<Pairs> hostile{{{"'; DROP TABLE part; --", "\"<b>\0x"s}},
                                     {{"long", std::string(100000, 'y')}},
                                     {{"Wänd", "Ω"}}};
    for (const auto& parts : {kParts, hostile}) {
        import(parts);
        const Store store = open_store(store_);
        const Scene scene = read_parts(store, 0);
        ASSERT_EQ(scene.parts.size(), 3U);
        for (std::uint32_t i = 0; i < 3; ++i)
            EXPECT_EQ(pairs(scene, i), parts[i]);
        verify(store);
    }
    EXPECT_THROW(read_parts(open_store(store_), 1), Error);
}

TEST_F(StoreProperties, AreCountedInTheSummary) {
    import(kParts);
    const StoreSummary found = summary(open_store(store_));
    ASSERT_EQ(found.properties.size(), 3U);
    EXPECT_EQ(found.properties[0].name, "Pset_X.Fire");
    EXPECT_EQ(found.properties[1].name, "storey");
    EXPECT_EQ(found.properties[1].parts, 2U);
    EXPECT_EQ(found.properties[2].parts, 1U);
    EXPECT_EQ(found.properties[2].values, 2U);
    EXPECT_EQ(found.relations, 0U);
    EXPECT_EQ(found.models[0].map_from_project, Transform());
}

TEST_F(StoreProperties, AChangeMakesAPartChanged) {
    import(kParts);
    auto parts = kParts;
    parts[0][1].second = "L3";
    const ImportReport second = import(parts);
    EXPECT_EQ(second.models[0].outcome, ImportOutcome::changed);
    EXPECT_EQ(second.models[0].changed, 1U);
    const Store store = open_store(store_);
    EXPECT_EQ(store.file().part(1).generation, 2U);
    EXPECT_EQ(store.file().part(2).generation, 1U);
    EXPECT_EQ(pairs(read_parts(store, 0), 0), parts[0]);
    verify(store);
    // The old value is used by no part any more.
    EXPECT_EQ(number("SELECT count(*) FROM property_value WHERE text = 'L1'"), 0);
    EXPECT_EQ(number("SELECT count(*) FROM property_value WHERE text = 'L3'"), 1);
    // The order of values is a change too: the first one is that of Properties::value.
    std::swap(parts[1][1], parts[1][2]);
    EXPECT_EQ(import(parts).models[0].changed, 1U);
}

TEST_F(StoreProperties, GoWithTheirParts) {
    import(kParts);
    import({{{ "storey", "other" }}, {}, {}}, "b.glb");
    remove_models({folder_ / "a.glb"}, store_);
    verify(open_store(store_));
    EXPECT_EQ(number("SELECT count(*) FROM part_property"), 1);
    EXPECT_EQ(number("SELECT count(*) FROM property_value"), 1);
    EXPECT_EQ(number("SELECT count(*) FROM property_name"), 1);
    // A part that is gone takes its properties along.
    import({{}}, "b.glb");
    verify(open_store(store_));
    EXPECT_EQ(number("SELECT count(*) FROM part_property"), 0);
}

TEST_F(StoreProperties, AJobsReportHasThem) {
    import(kParts);
    const StoreClashReport found = find_clashes(open_store(store_), {});
    ASSERT_EQ(found.report.clashes.size(), 1U);
    const Scene& model = found.models.at(0);
    ASSERT_EQ(model.parts.size(), 2U) << "only parts that clash are listed";
    EXPECT_EQ(model.properties.value(0, "Pset_X.Fire"), "F60");
    EXPECT_EQ(model.properties.value(1, "system"), "B");
}

TEST_F(StoreProperties, RelationsAreReadForTheListedParts) {
    import(kParts);
    {
        Database database(store_, OpenMode::read_write);
        const std::vector<PartRelation> relations{{0, 1, RelationKind::fills},
                                                  {1, 2, RelationKind::connected}};
        write_relations(database, relations, std::vector<std::int64_t>{1, 2, 3});
    }
    StoreFile file(store_, true);
    EXPECT_EQ(file.relations(std::vector<std::int64_t>{2, 1}),
              (std::vector<PartRelation>{{1, 0, RelationKind::fills}}));
    expect_damage(); // the parts' checksums do not know them
}

TEST_F(StoreProperties, DamageIsNoticed) {
    for (const char* const sql : {
             "UPDATE property_value SET text = 'L9' WHERE text = 'L1'",
             "DELETE FROM property_value WHERE text = 'L1'",
             "UPDATE part_property SET value = value + 1 WHERE value = 1",
             "DELETE FROM part_property WHERE part = 2",
             "UPDATE part SET properties = properties + 1 WHERE part = 3",
             "INSERT INTO part_property VALUES (77, 0, 1, 1)",
         }) {
        SCOPED_TRACE(sql);
        std::filesystem::remove(store_);
        import(kParts);
        change(sql);
        expect_damage();
    }
}

TEST_F(StoreProperties, QueriesOfTheirPageWork) {
    import(kParts);
    EXPECT_EQ(rows_of_page_queries("properties.md", store_), (std::vector<int>{2, 2, 0, 0}));
}

} // namespace
} // namespace abut::test
