// Views of random trees with a renderer that only counts: residency, memory, threads, errors.
#include <abut/error.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/level_trees.h"
#include "view/level_view.h"

#include <atomic>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::test {
namespace {

/// Does what a renderer does with a frame, and checks it.
class CountingRenderer {
public:
    CountingRenderer(const LevelModel& model, const ViewOptions& options)
        : model_(model), options_(options) {}

    void draw(const ViewFrame& frame, const ViewStatistics& statistics) {
        for (const std::uint32_t chunk : frame.drops)
            if (has_.erase(chunk) > 0)
                bytes_ -= model_.tree.chunks[chunk].bytes();
        for (const ChunkUpload& upload : frame.uploads) {
            ASSERT_TRUE(has_.insert(upload.chunk).second) << "uploaded twice";
            ASSERT_EQ(upload.data->indices, model_.chunks[upload.chunk].indices);
            bytes_ += model_.tree.chunks[upload.chunk].bytes();
        }
        ASSERT_LE(bytes_, options_.gpu_memory);
        ASSERT_EQ(bytes_, statistics.gpu_bytes);
        ASSERT_LE(statistics.peak_gpu_bytes, options_.gpu_memory);
        ASSERT_LE(statistics.peak_bytes, options_.memory);
        ASSERT_LE(statistics.draw_calls, options_.draw_budget);
        ASSERT_LE(statistics.triangles, options_.triangle_budget); // while chunks are read, too
        ASSERT_EQ(statistics.draw_calls, frame.draws.size());
        std::set<std::uint32_t> chunks;
        for (const ChunkDraw& draw : frame.draws) {
            ASSERT_TRUE(has_.contains(draw.chunk)) << "the renderer does not have it";
            ASSERT_TRUE(chunks.insert(draw.chunk).second) << "two draw calls of a chunk";
            ASSERT_LE(draw.first_instance + draw.instances, frame.instances.size());
        }
    }

private:
    const LevelModel& model_;
    const ViewOptions& options_;
    std::set<std::uint32_t> has_;
    std::uint64_t bytes_ = 0;
};

ChunkSource source_of(const LevelModel& model) {
    return [&model](std::uint32_t chunk) { return model.chunks[chunk]; };
}

/// What a frame draws, in an order of its own.
std::multiset<std::vector<float>> picture(const ViewFrame& frame) {
    std::multiset<std::vector<float>> result;
    for (const ChunkDraw& draw : frame.draws) {
        if (draw.instances == 0)
            result.insert({static_cast<float>(draw.chunk)});
        for (std::uint32_t i = 0; i < draw.instances; ++i) {
            const ChunkInstance& instance = frame.instances[draw.first_instance + i];
            std::vector<float> one{static_cast<float>(draw.chunk),
                                   static_cast<float>(instance.part)};
            one.insert(one.end(), instance.rows.begin(), instance.rows.end());
            result.insert(one);
        }
    }
    return result;
}

LevelModel levels_for_view(Random& random) {
    LevelModelMaker::Options options;
    options.depth = random.integer(2, 5);
    options.most_triangles = 200;
    return LevelModelMaker(random, options).make();
}

ViewOptions options_for(Random& random, const LevelModel& model) {
    ViewOptions options;
    options.pixel_error = std::pow(10, random.uniform(-1, 1));
    // The root must fit; from barely that to everything.
    std::uint64_t all = 0, largest = 0;
    for (const ChunkSize& size : model.tree.chunks) {
        all += size.bytes();
        largest = std::max(largest, size.bytes());
    }
    const double share = std::pow(random.uniform(0, 1), 3);
    options.gpu_memory = 4 * largest + static_cast<std::uint64_t>(share * 1.2 * double(all));
    options.memory =
        (std::uint64_t{1} << 20) + static_cast<std::uint64_t>(random.uniform(0, 1) * double(all));
    options.upload_budget = random.chance(0.5) ? options.upload_budget : 5000;
    if (random.chance(0.3))
        options.triangle_budget = static_cast<std::uint64_t>(random.integer(200, 5000));
    if (random.chance(0.3))
        options.draw_budget = static_cast<std::uint32_t>(random.integer(1, 50));
    return options;
}

void draw_frames(LevelView& view, CountingRenderer& renderer, Random& random,
                 const LevelModel& model) {
    CameraMotion motion{random_camera(random, model.tree.origin, 50), 5 * random.direction(), {}};
    for (int k = 0; k < 10; ++k) {
        ASSERT_NO_FATAL_FAILURE(renderer.draw(view.frame(motion), view.statistics()));
        motion.camera.eye = motion.camera.eye + random.uniform(0, 1) * motion.velocity;
        if (random.chance(0.3))
            view.wait();
    }
}

TEST(LevelView, EveryCameraIsShownWithinTheMemory) {
    Random random(131);
    int complete = 0, limited = 0, dropped = 0;
    for (int i = 0; i < many(120); ++i) {
        const LevelModel model = levels_for_view(random);
        ViewOptions options = options_for(random, model);
        LevelView view(model.tree, source_of(model), "store", options);
        CountingRenderer renderer(model, options);
        view.set_occlusion(false); // occluders depend on what is in memory
        for (int k = 0; k < 4; ++k) {
            draw_frames(view, renderer, random, model);
            if (HasFatalFailure())
                return;
            const Camera camera = random_camera(random, model.tree.origin, 50);
            bool loaded = false;
            for (int tries = 0; tries < 200 && !loaded; ++tries) {
                const ViewFrame& frame = view.frame({camera, {}, {}});
                ASSERT_NO_FATAL_FAILURE(renderer.draw(frame, view.statistics()));
                dropped += frame.drops.empty() ? 0 : 1;
                loaded = frame.loaded;
                view.wait();
            }
            ASSERT_TRUE(loaded);
            const ViewFrame& frame = view.frame({camera, {}, {}});
            ASSERT_NO_FATAL_FAILURE(renderer.draw(frame, view.statistics()));
            ASSERT_EQ(view.statistics().missing, 0U);
            (frame.complete ? complete : limited) += 1;
            // A view that starts here shows the same.
            ViewOptions at_once = options;
            at_once.background = false;
            at_once.memory = std::uint64_t{1} << 30;
            LevelView fresh(model.tree, source_of(model), "store", at_once);
            fresh.set_occlusion(false);
            const ViewFrame& other = fresh.frame({camera, {}, {}});
            ASSERT_TRUE(other.loaded);
            ASSERT_EQ(picture(frame), picture(other));
            ASSERT_EQ(frame.complete, other.complete);
            ASSERT_LE(view.statistics().triangles, options.triangle_budget);
        }
    }
    EXPECT_GT(complete, many(120));
    EXPECT_GT(limited, many(120) / 4);
    EXPECT_GT(dropped, many(120) / 8);
}

TEST(LevelView, ReadsAtOnceWithoutAThread) {
    Random random(132);
    for (int i = 0; i < many(100); ++i) {
        const LevelModel model = levels_for_view(random);
        ViewOptions options = options_for(random, model);
        options.background = false;
        LevelView view(model.tree, source_of(model), "store", options);
        CountingRenderer renderer(model, options);
        for (int k = 0; k < 5; ++k) {
            const Camera camera = random_camera(random, model.tree.origin, 50);
            bool loaded = false;
            for (int tries = 0; tries < 50 && !loaded; ++tries) { // memory may hold a share only
                const ViewFrame& frame = view.frame({camera, {}, {}});
                ASSERT_NO_FATAL_FAILURE(renderer.draw(frame, view.statistics()));
                loaded = frame.loaded;
            }
            ASSERT_TRUE(loaded);
        }
    }
}

TEST(LevelView, AnErrorOfTheThreadReachesAFrameOnce) {
    Random random(133);
    const LevelModel model = levels_for_view(random);
    for (const bool background : {true, false}) {
        ViewOptions options;
        options.background = background;
        options.pixel_error = 1e-3;
        const auto bad_node = std::ranges::find_if(model.tree.nodes, [](const LevelNode& node) {
            return node.error == 0 && node.chunk != kNoChunk;
        });
        ASSERT_NE(bad_node, model.tree.nodes.end());
        const std::uint32_t bad = bad_node->chunk;
        const auto source = [&](std::uint32_t chunk) {
            if (chunk == bad)
                throw Error(ErrorCode::malformed, "store", "chunk is damaged");
            return model.chunks[chunk];
        };
        LevelView view(model.tree, source, "store", options);
        CountingRenderer renderer(model, options);
        Camera camera;
        camera.eye = model.tree.origin + Vec3{0, -200, 0};
        camera.forward = {0, 1, 0};
        int errors = 0;
        bool loaded = false;
        for (int k = 0; k < 50 && !loaded; ++k) {
            try {
                const ViewFrame& frame = view.frame({camera, {}, {}});
                ASSERT_NO_FATAL_FAILURE(renderer.draw(frame, view.statistics()));
                loaded = frame.loaded;
            } catch (const Error& error) {
                ++errors;
                EXPECT_EQ(error.code(), ErrorCode::malformed);
            }
            view.wait();
        }
        EXPECT_TRUE(loaded);
        EXPECT_EQ(errors, 1);
    }
}

TEST(LevelView, RefusesBadOptions) {
    Random random(134);
    const LevelModel model = levels_for_view(random);
    const auto make = [&](const std::function<void(ViewOptions&)>& change) {
        ViewOptions options;
        change(options);
        return std::make_unique<LevelView>(model.tree, source_of(model), "a.abut", options);
    };
    EXPECT_NO_THROW(make([](ViewOptions&) {}));
    EXPECT_THROW(make([](ViewOptions& o) { o.pixel_error = 0; }), Error);
    EXPECT_THROW(make([](ViewOptions& o) { o.pixel_error = NAN; }), Error);
    EXPECT_THROW(make([](ViewOptions& o) { o.look_ahead = -1; }), Error);
    EXPECT_THROW(make([](ViewOptions& o) { o.look_ahead = HUGE_VAL; }), Error);
    EXPECT_THROW(make([](ViewOptions& o) { o.gpu_memory = 10; }), Error);
    try {
        make([](ViewOptions& o) { o.memory = 1000; });
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_EQ(std::string(error.what()).find("a.abut: viewing it needs at least "), 0U);
    }
    const auto view = make([](ViewOptions&) {});
    EXPECT_THROW(view->set_hidden(1'000'000, true), Error);
    Camera camera;
    camera.forward = {};
    EXPECT_THROW(view->frame({camera, {}, {}}), Error);
    EXPECT_THROW(view->frame({Camera{}, {NAN, 0, 0}, {}}), Error);
    EXPECT_NO_THROW(view->frame({Camera{}, {1e300, 0, 0}, {1e300, 0, 0}}));
}

TEST(LevelView, RefusesDamagedTrees) {
    Random random(135);
    int refused = 0;
    for (int i = 0; i < many(1000); ++i) {
        LevelModel model = levels_for_view(random);
        LevelTree& tree = model.tree;
        const auto any = [&](auto& list) -> auto& {
            return list[static_cast<std::size_t>(random.integer(0, int(list.size()) - 1))];
        };
        const auto number = static_cast<std::uint32_t>(random.integer(0, 1000));
        switch (random.integer(0, 9)) {
        case 0:
            any(tree.nodes).first_child = number;
            break;
        case 1:
            any(tree.nodes).children = number;
            break;
        case 2:
            any(tree.nodes).chunk = number;
            break;
        case 3:
            any(tree.nodes).instance = number;
            break;
        case 4:
            any(tree.nodes).error = random.chance(0.5) ? NAN : -1;
            break;
        case 5:
            any(tree.nodes).lower[1] = random.chance(0.5) ? NAN : INFINITY;
            break;
        case 6:
            any(tree.meshes).levels = number;
            break;
        case 7:
            any(tree.mesh_levels).chunk = kNoChunk - (number % 2);
            break;
        case 8:
            any(tree.meshes).first_level = number;
            break;
        default:
            tree.nodes.pop_back();
            break;
        }
        ViewOptions options;
        options.background = false;
        try {
            LevelView view(tree, source_of(model), "store", options);
            (void)view.frame({random_camera(random, tree.origin, 50), {}, {}});
        } catch (const Error& error) {
            ++refused;
        }
    }
    EXPECT_GT(refused, many(1000) / 3);
}

} // namespace
} // namespace abut::test
