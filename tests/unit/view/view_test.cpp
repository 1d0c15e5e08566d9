// Views of small stores.
#include <abut/error.h>
#include <abut/levels.h>
#include <abut/view.h>

#include "math/vector.h"
#include "scenes/plant/plant.h"
#include "store/database/sqlite.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

class ViewOfStore : public testing::Test {
protected:
    Store plant(std::uint64_t triangles) {
        scene_ = make_plant({.triangles = triangles, .clashes = 0, .distinct = true}).scene;
        return stored(scene_);
    }
    Store stored(const Scene& scene) {
        write_glb(scene, folder_ / "plant.glb");
        (void)import_models({folder_ / "plant.glb"}, store_);
        (void)build_levels(store_);
        return open_store(store_);
    }
    static Camera overview(const View& view) {
        return look_at_box(view.bounds(), {1, -1, 1}, {0, 1, 0});
    }

    Folder folder_;
    std::string store_ = folder_ / "plant.abut";
    Scene scene_;
};

TEST_F(ViewOfStore, BecomesComplete) {
    View view(plant(30'000), {.triangle_budget = 1'000'000});
    const Camera camera = overview(view);
    bool complete = false;
    std::size_t uploads = 0;
    for (int i = 0; i < 20 && !complete; ++i) {
        const ViewFrame& frame = view.frame(camera);
        uploads += frame.uploads.size();
        complete = frame.complete;
        EXPECT_TRUE(!complete || frame.loaded);
        view.wait();
    }
    EXPECT_TRUE(complete);
    EXPECT_GT(uploads, 0U);
    EXPECT_GT(view.statistics().triangles, 0U);
    EXPECT_LE(view.statistics().peak_bytes, ViewOptions().memory);
}

// The second thread may hold its lock while the first frame asks, most likely as it starts.
TEST_F(ViewOfStore, AWaitAfterTheFirstFrameLoadsAll) {
    const Store store = plant(10'000);
    for (int i = 0; i < 200; ++i) {
        View view(store);
        const Camera camera = overview(view);
        (void)view.frame(camera);
        view.wait();
        ASSERT_TRUE(view.frame(camera).loaded) << "view " << i;
    }
}

TEST_F(ViewOfStore, KnowsItsParts) {
    const View view(plant(30'000));
    EXPECT_EQ(view.up(), UpAxis::y);
    ASSERT_EQ(view.parts().size(), scene_.parts.size());
    Box3 all;
    for (std::uint32_t i = 0; i < view.parts().size(); ++i) {
        const ViewPart part = view.part(i);
        ASSERT_EQ(part.number, view.parts()[i]);
        ASSERT_EQ(view.index_of(part.number), i);
        ASSERT_EQ(part.id, scene_.parts[i].id);
        ASSERT_EQ(part.name, scene_.parts[i].name);
        ASSERT_EQ(part.type, scene_.parts[i].type);
        ASSERT_EQ(part.file, folder_ / "plant.glb");
        extend(all, part.box.lower), extend(all, part.box.upper);
    }
    EXPECT_TRUE(encloses(grown(view.bounds(), 1e-4), all));
    EXPECT_FALSE(view.index_of(-1).has_value());
    EXPECT_FALSE(view.index_of(view.parts().back() + 1).has_value());
    EXPECT_THROW((void)view.part(static_cast<std::uint32_t>(view.parts().size())), Error);
}

TEST_F(ViewOfStore, FindsPartsByText) {
    const View view(plant(30'000));
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < scene_.parts.size(); ++i) {
        const Part& part = scene_.parts[i];
        for (const std::string& text : {part.id, part.name, part.type})
            if (text.find("Tank") != std::string::npos || text.find("tank") != std::string::npos) {
                expected.push_back(i);
                break;
            }
    }
    ASSERT_GT(expected.size(), 1U);
    EXPECT_EQ(view.find_parts("TANK", 10'000, 0, 1e9).parts, expected);
    const FoundParts first = view.find_parts("tank", 1, 0, 1e9);
    ASSERT_EQ(first.parts, std::vector<std::uint32_t>{expected[0]});
    EXPECT_EQ(view.find_parts("tank", 1, first.next, 1e9).parts[0], expected[1]);
    EXPECT_TRUE(view.find_parts("no such name", 5, 0, 1e9).parts.empty());
    EXPECT_EQ(view.find_parts("", 3, 0, 1e9).parts, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(view.find_parts("tank", 0).parts.empty());
    // Without time, each call still gets on.
    std::vector<std::uint32_t> in_steps;
    int calls = 0;
    for (std::uint32_t from = 0; from < view.parts().size(); ++calls) {
        const FoundParts found = view.find_parts("tank", 10'000, from, 0);
        ASSERT_GT(found.next, from);
        from = found.next;
        in_steps.insert(in_steps.end(), found.parts.begin(), found.parts.end());
    }
    EXPECT_EQ(in_steps, expected);
    EXPECT_GT(calls, 2);
}

TEST_F(ViewOfStore, IsMovable) {
    View a(plant(10'000));
    View b = std::move(a);
    (void)b.frame(overview(b));
    b.wait();
    EXPECT_FALSE(b.frame(overview(b)).draws.empty());
}

TEST_F(ViewOfStore, NamesADamagedChunk) {
    plant(10'000);
    {
        Database database(store_, OpenMode::read_write);
        database.run("UPDATE level_chunk SET data = zeroblob(length(data))");
    }
    for (const bool background : {true, false}) {
        View view(open_store(store_), {.background = background});
        try {
            (void)view.frame(overview(view));
            view.wait();
            (void)view.frame(overview(view));
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::malformed);
            EXPECT_EQ(error.file(), store_);
        }
        // Each chunk is tried once; then the view goes on without it.
        bool goes_on = false;
        for (int i = 0; i < 1000 && !goes_on; ++i) {
            try {
                goes_on = view.frame(overview(view)).loaded;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::malformed);
            }
            view.wait();
        }
        EXPECT_TRUE(goes_on);
    }
}

TEST_F(ViewOfStore, NeedsLevels) {
    write_glb(make_plant({.triangles = 10'000}).scene, folder_ / "plant.glb");
    (void)import_models({folder_ / "plant.glb"}, store_);
    try {
        const View view(open_store(store_));
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_EQ(error.file(), store_);
    }
}

} // namespace
} // namespace abut::test
