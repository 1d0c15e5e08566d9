// Cuts of random trees, compared with their definition.
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/level_trees.h"
#include "view/selection/level_cut.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <vector>

namespace abut::test {
namespace {

using Item = std::pair<std::uint32_t, std::uint32_t>; ///< node, level

LevelModel random_levels(Random& random) {
    LevelModelMaker::Options options;
    options.depth = random.integer(0, 5);
    options.instances = random.chance(0.3) ? 0 : random.uniform(0, 1);
    options.half = std::pow(10, random.uniform(-1, 3));
    return LevelModelMaker(random, options).make();
}

/// A tree, a camera and a cut, checked by recursion.
class CheckedCut {
public:
    CheckedCut(const LevelTree& levels, const Camera& at)
        : tree(levels), items(levels), camera(at), view(at, levels.origin) {}

    /// Returns whether a random point of the box is certainly in the picture.
    bool sees_point(const LevelNode& node, Random& random) const {
        Vec3 p;
        p.x = random.uniform(node.lower[0], node.upper[0]);
        p.y = random.uniform(node.lower[1], node.upper[1]);
        p.z = random.uniform(node.lower[2], node.upper[2]);
        const Vec3 d = p - (camera.eye - tree.origin);
        const CameraFrame frame(camera);
        const double ahead = dot(d, frame.forward);
        return std::abs(dot(d, frame.right)) < frame.slope_x * ahead &&
               std::abs(dot(d, frame.up)) < frame.slope_y * ahead && ahead > camera.near &&
               ahead < camera.far;
    }
    /// Returns whether all corners of the box are outside of one plane, by more than rounding.
    bool is_outside(const LevelNode& node) const {
        const CameraFrame frame(camera);
        std::array<int, 6> outside{};
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 p{(corner & 1U) != 0 ? node.upper[0] : node.lower[0],
                         (corner & 2U) != 0 ? node.upper[1] : node.lower[1],
                         (corner & 4U) != 0 ? node.upper[2] : node.lower[2]};
            const Vec3 d = p - (camera.eye - tree.origin);
            const double ahead = dot(d, frame.forward), right = dot(d, frame.right),
                         up = dot(d, frame.up), margin = 1e-6;
            outside[0] += right > frame.slope_x * ahead + margin ? 1 : 0;
            outside[1] += -right > frame.slope_x * ahead + margin ? 1 : 0;
            outside[2] += up > frame.slope_y * ahead + margin ? 1 : 0;
            outside[3] += -up > frame.slope_y * ahead + margin ? 1 : 0;
            outside[4] += ahead < camera.near - margin ? 1 : 0;
            outside[5] += ahead > camera.far + margin ? 1 : 0;
        }
        return std::ranges::count(outside, 8) > 0;
    }
    /// The largest 1 + x^2 + y^2 of the box's corners within the picture, or that of its corners.
    double stretch(const LevelNode& node) const {
        const CameraFrame frame(camera);
        double x = 0, y = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 p{(corner & 1U) != 0 ? node.upper[0] : node.lower[0],
                         (corner & 2U) != 0 ? node.upper[1] : node.lower[1],
                         (corner & 4U) != 0 ? node.upper[2] : node.lower[2]};
            const Vec3 d = p - (camera.eye - tree.origin);
            const double ahead = dot(d, frame.forward);
            x = ahead > 0 ? std::max(x, std::abs(dot(d, frame.right)) / ahead) : HUGE_VAL;
            y = ahead > 0 ? std::max(y, std::abs(dot(d, frame.up)) / ahead) : HUGE_VAL;
        }
        x = std::min(x, frame.slope_x), y = std::min(y, frame.slope_y);
        return 1 + x * x + y * y;
    }
    double pixels(Item item) const {
        const LevelNode& node = tree.nodes[item.first];
        double square = 0;
        const Vec3 eye = camera.eye - tree.origin;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = component(eye, static_cast<int>(axis));
            const double nearest =
                std::clamp(at, double{node.lower.at(axis)}, double{node.upper.at(axis)});
            square += (at - nearest) * (at - nearest);
        }
        const double height = 2 * std::tan(camera.field_of_view / 2);
        return 2 * double{items.error({item.first, item.second})} * stretch(node) * camera.height /
               height / std::max(std::sqrt(square), camera.near);
    }
    std::vector<Item> finer(Item item) const {
        std::vector<Item> result;
        if (items.has_finer({item.first, item.second}))
            items.for_each_finer({item.first, item.second}, [&](ViewItem child) {
                result.emplace_back(child.node, child.level);
            });
        return result;
    }

    const LevelTree& tree;
    ViewItems items;
    Camera camera;
    ViewPoint view;
};

std::set<Item> cut_of(const LevelCut& cut) {
    std::set<Item> result;
    for (const CutEntry& entry : cut.entries())
        if (!entry.is_replaced)
            result.emplace(entry.item.node, entry.item.level);
    return result;
}

/// Checks that items below `item` cover every leaf with a visible point exactly once.
class Coverage {
public:
    Coverage(const CheckedCut& cut, const std::set<Item>& drawn, Random& random)
        : cut_(cut), drawn_(drawn), random_(random) {}

    void check(Item item, int times) {
        times += drawn_.contains(item) ? 1 : 0;
        ASSERT_LE(times, 1) << "something is drawn twice";
        const std::vector<Item> finer = cut_.finer(item);
        for (const Item& child : finer)
            check(child, times);
        if (finer.empty() && cut_.sees_point(cut_.tree.nodes[item.first], random_)) {
            ++visible;
            ASSERT_EQ(times, 1) << "a hole";
        }
    }
    int visible = 0;

private:
    const CheckedCut& cut_;
    const std::set<Item>& drawn_;
    Random& random_;
};

TEST(LevelCut, ErrorsInPixelsHoldInTheWholePicture) {
    Random random(127);
    int seen = 0, corner = 0;
    double largest = 0;
    for (int i = 0; i < many(20'000); ++i) {
        Camera camera;
        camera.eye = random.in_cube(5);
        camera.forward = random.direction();
        camera.up = perpendicular(camera.forward);
        camera.field_of_view = random.uniform(0.3, 2);
        camera.width = 1280, camera.height = 720;
        const CameraFrame frame(camera);
        const Vec3 low = random.in_cube(20), size = random.in_cube(3);
        LevelNode node;
        for (std::size_t a = 0; a < 3; ++a) {
            const double from = component(low, int(a)), by = std::abs(component(size, int(a)));
            node.lower.at(a) = float(from), node.upper.at(a) = float(from + by);
        }
        const ViewPoint view(camera, {});
        const auto image = [&](const Vec3& p) {
            const Vec3 d = p - camera.eye;
            const double ahead = dot(d, frame.forward), scale = view.pixels_at_one / ahead;
            return Vec3{scale * dot(d, frame.right), scale * dot(d, frame.up), ahead};
        };
        const Vec3 p{random.uniform(node.lower[0], node.upper[0]),
                     random.uniform(node.lower[1], node.upper[1]),
                     random.uniform(node.lower[2], node.upper[2])};
        const Vec3 at = image(p);
        if (!(at.z > camera.near) || std::abs(at.x) > 640 || std::abs(at.y) > 360)
            continue;
        ++seen;
        corner += std::abs(at.x) > 500 && std::abs(at.y) > 250 ? 1 : 0;
        const double distance = std::sqrt(distance_sq(node, view.eye));
        const double error = 1e-4 * length(p - camera.eye);
        const double bound = 0.5 * view.pixels(error, node, distance);
        for (int k = 0; k < 8; ++k) {
            const Vec3 moved = image(p + error * random.direction());
            const double by = std::hypot(moved.x - at.x, moved.y - at.y);
            largest = std::max(largest, by / bound);
            ASSERT_LE(by, 1.001 * bound);
        }
    }
    std::cout << seen << " points seen, " << corner << " in a corner, " << largest
              << " of the bound at most\n";
    EXPECT_GT(seen, many(20'000) / 100);
    EXPECT_GT(corner, 0);
    EXPECT_GT(largest, 0.9);
}

TEST(LevelCut, CoversWhatIsVisibleOnceWithinTheError) {
    Random random(121);
    int visible = 0, partly = 0, coarse = 0;
    for (int i = 0; i < many(1500); ++i) {
        const LevelModel model = random_levels(random);
        const CheckedCut checked(
            model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
        LevelCut cut(model.tree);
        const double error = std::pow(10, random.uniform(-1, 2));
        cut.choose(checked.view, {error});
        const std::set<Item> drawn = cut_of(cut);
        Coverage coverage(checked, drawn, random);
        coverage.check({0, 0}, 0);
        visible += coverage.visible;
        for (const Item& item : drawn)
            ASSERT_LE(checked.pixels(item), error * (1 + 1e-5));
        ASSERT_LE(cut.error(), error * (1 + 1e-5));
        partly += !drawn.empty() && cut.outside() > 0 ? 1 : 0;
        for (const CutEntry& entry : cut.entries()) {
            const Item item{entry.item.node, entry.item.level};
            ASSERT_NEAR(entry.error, checked.pixels(item), 1e-5 * checked.pixels(item));
            // Nothing is finer than needed, and nothing outside is kept.
            if (entry.is_replaced) {
                ASSERT_GT(checked.pixels(item), error * (1 - 1e-5));
            }
            coarse += !entry.is_replaced && checked.items.has_finer(entry.item) ? 1 : 0;
            ASSERT_FALSE(checked.is_outside(model.tree.nodes[entry.item.node]));
        }
    }
    EXPECT_GT(visible, many(1500) * 2);
    EXPECT_GT(partly, many(1500) / 8);
    EXPECT_GT(coarse, many(1500) / 2);
}

TEST(LevelCut, KeepsBudgetsAndForgetsTheLastCamera) {
    Random random(122);
    int limited = 0, free = 0;
    for (int i = 0; i < many(300); ++i) {
        const LevelModel model = random_levels(random);
        LevelCut cut(model.tree);
        for (int k = 0; k < 5; ++k) {
            const CheckedCut checked(
                model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
            CutLimits limits{0.01};
            if (random.chance(0.7))
                limits.triangles = static_cast<std::uint64_t>(random.integer(40, 4000));
            if (random.chance(0.5))
                limits.draws = static_cast<std::uint32_t>(random.integer(1, 100));
            if (random.chance(0.5))
                limits.bytes = static_cast<std::uint64_t>(random.integer(2000, 100000));
            cut.choose(checked.view, limits);
            const std::set<Item> drawn = cut_of(cut);
            std::uint64_t triangles = 0, bytes = 0;
            std::set<std::uint32_t> chunks, held;
            for (const CutEntry& entry : cut.entries()) {
                if (held.insert(entry.chunk).second)
                    bytes += model.tree.chunks[entry.chunk].bytes();
                if (entry.is_replaced)
                    continue;
                triangles += model.tree.chunks[entry.chunk].triangles;
                chunks.insert(entry.chunk);
            }
            ASSERT_EQ(triangles, cut.triangles());
            ASSERT_EQ(chunks.size(), cut.draws());
            if (!drawn.contains({0, 0})) { // the root is drawn whatever it takes
                ASSERT_LE(triangles, limits.triangles);
                ASSERT_LE(chunks.size(), limits.draws);
                ASSERT_LE(bytes, limits.bytes);
            }
            Coverage(checked, drawn, random).check({0, 0}, 0);
            (cut.error() > limits.pixel_error ? limited : free) += 1;
            LevelCut fresh(model.tree);
            fresh.choose(checked.view, limits);
            ASSERT_EQ(cut_of(fresh), drawn);
        }
    }
    EXPECT_GT(limited, many(300) / 2);
    EXPECT_GT(free, many(300) / 4);
}

/// The finest cover of an item with chunks that are there, by recursion. Empty and false if there
/// is none.
bool finest_cover(const CheckedCut& cut, const std::map<Item, const CutEntry*>& entries,
                  const std::vector<bool>& is_there, Item item, std::set<Item>& cover) {
    const CutEntry& entry = *entries.at(item);
    if (entry.is_replaced) {
        std::set<Item> finer;
        bool all = true;
        for (const Item& child : cut.finer(item))
            if (entries.contains(child))
                all = finest_cover(cut, entries, is_there, child, finer) && all;
        if (all) {
            cover.insert(finer.begin(), finer.end());
            return true;
        }
    }
    if (is_there[entry.chunk])
        cover.insert(item);
    return is_there[entry.chunk];
}

TEST(DrawnCut, IsTheFinestCoverOfWhatIsThere) {
    Random random(123);
    int stand_ins = 0, holes = 0;
    for (int i = 0; i < many(1000); ++i) {
        const LevelModel model = random_levels(random);
        const CheckedCut checked(
            model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
        LevelCut cut(model.tree);
        cut.choose(checked.view, {0.5});
        std::vector<bool> is_there(model.tree.chunks.size());
        const double share = random.uniform(0.3, 1);
        for (std::size_t k = 0; k < is_there.size(); ++k)
            is_there[k] = random.chance(share);
        if (random.chance(0.9))
            is_there[model.tree.nodes[0].chunk] = true;
        DrawnCut drawn;
        drawn.choose(cut.entries(), [&](std::uint32_t chunk) { return is_there[chunk]; });
        std::set<Item> items;
        for (const std::uint32_t at : drawn.drawn()) {
            const CutEntry& entry = cut.entries()[at];
            ASSERT_TRUE(is_there[entry.chunk]);
            items.emplace(entry.item.node, entry.item.level);
            stand_ins += entry.is_replaced ? 1 : 0;
        }
        std::map<Item, const CutEntry*> entries;
        for (const CutEntry& entry : cut.entries())
            entries[{entry.item.node, entry.item.level}] = &entry;
        std::set<Item> cover;
        if (entries.empty())
            continue;
        if (finest_cover(checked, entries, is_there, {0, 0}, cover)) {
            ASSERT_FALSE(drawn.has_hole());
            ASSERT_EQ(items, cover);
            Coverage(checked, items, random).check({0, 0}, 0);
        } else {
            ++holes;
            ASSERT_TRUE(drawn.has_hole());
            ASSERT_FALSE(is_there[model.tree.nodes[0].chunk]);
        }
    }
    EXPECT_GT(stand_ins, many(1000) / 4);
    EXPECT_GT(holes, many(1000) / 200);
}

TEST(LevelCut, DoesNotFillTheLastGapsWithWhatDoesNotShow) {
    Random random(126);
    int full = 0, tried = 0;
    for (int i = 0; i < many(200); ++i) {
        LevelModelMaker::Options options;
        options.depth = 5;
        options.instances = 0;
        options.most_triangles = 20;
        const LevelModel model = LevelModelMaker(random, options).make();
        const CheckedCut checked(
            model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
        std::uint64_t largest = 0; ///< number of triangles that a replacement adds
        for (const LevelNode& node : model.tree.nodes) {
            std::uint64_t finer = 0;
            for (std::uint32_t k = 0; k < node.children; ++k)
                finer += model.tree.chunks[model.tree.nodes[node.first_child + k].chunk].triangles;
            largest = std::max(largest, finer);
        }
        CutLimits limits{1e-3};
        limits.triangles = 8 * largest + static_cast<std::uint64_t>(random.integer(8, 800));
        LevelCut cut(model.tree);
        cut.choose(checked.view, limits);
        // The first item that does not fit is met in a cut that is almost full, and has the largest
        // error of those that stay.
        for (const CutEntry& entry : cut.entries()) {
            const bool is_fine = !checked.items.has_finer(entry.item);
            if (entry.is_replaced) {
                ASSERT_GE(entry.error, 0.5 * cut.error() * (1 - 1e-6));
                tried += cut.error() > limits.pixel_error && entry.error < cut.error() ? 1 : 0;
            }
            full +=
                !entry.is_replaced && !is_fine && double{entry.error} < 0.5 * cut.error() ? 1 : 0;
        }
    }
    EXPECT_GT(full, many(200));
    EXPECT_GT(tried, many(200) / 10);
}

TEST(LevelCut, AmongWhatIsThereIsAsFineAsItCanBe) {
    Random random(125);
    int kept = 0, replaced = 0, limited = 0;
    for (int i = 0; i < many(600); ++i) {
        const LevelModel model = random_levels(random);
        const CheckedCut checked(
            model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
        std::vector<bool> is_there(model.tree.chunks.size());
        const double share = random.uniform(0.5, 1);
        for (std::size_t k = 0; k < is_there.size(); ++k)
            is_there[k] = random.chance(share);
        is_there[model.tree.nodes[0].chunk] = true;
        const NotDrawn these{nullptr, nullptr,
                             [&](std::uint32_t chunk) { return bool{is_there[chunk]}; }};
        LevelCut cut(model.tree), all(model.tree);
        cut.choose(checked.view, {0.5}, these);
        all.choose(checked.view, {0.5});
        std::set<Item> visible;
        for (const CutEntry& entry : all.entries())
            visible.emplace(entry.item.node, entry.item.level);
        const std::set<Item> drawn = cut_of(cut);
        Coverage(checked, drawn, random).check({0, 0}, 0);
        for (const CutEntry& entry : cut.entries()) {
            ASSERT_TRUE(is_there[entry.chunk]);
            replaced += entry.is_replaced ? 1 : 0;
            if (entry.is_replaced || !checked.items.has_finer(entry.item) || !(entry.error > 0.5F))
                continue;
            bool can_be_finer = true;
            for (const Item& child : checked.finer({entry.item.node, entry.item.level}))
                if (visible.contains(child))
                    can_be_finer =
                        can_be_finer && is_there[checked.items.chunk({child.first, child.second})];
            ASSERT_FALSE(can_be_finer);
            ++kept;
        }
        CutLimits limits{0.5};
        limits.triangles = static_cast<std::uint64_t>(random.integer(200, 2000));
        cut.choose(checked.view, limits, these);
        if (!cut_of(cut).contains({0, 0})) {
            ASSERT_LE(cut.triangles(), limits.triangles);
            ++limited;
        }
    }
    EXPECT_GT(kept, many(600) / 4);
    EXPECT_GT(replaced, many(600));
    EXPECT_GT(limited, many(600) / 4);
}

TEST(LevelCut, LeavesOutHiddenInstances) {
    Random random(124);
    int hidden_instances = 0;
    for (int i = 0; i < many(200); ++i) {
        const LevelModel model = random_levels(random);
        const CheckedCut checked(
            model.tree, random_camera(random, model.tree.origin, model.tree.nodes[0].upper[0]));
        std::vector<bool> hidden(model.tree.parts.size());
        for (std::size_t k = 0; k < hidden.size(); ++k)
            hidden[k] = random.chance(0.3);
        LevelCut cut(model.tree), all(model.tree);
        cut.choose(checked.view, {1e-3}, {&hidden});
        all.choose(checked.view, {1e-3});
        std::set<Item> expected = cut_of(all);
        std::erase_if(expected, [&](const Item& item) {
            const std::uint32_t instance = model.tree.nodes[item.first].instance;
            const bool is_hidden =
                instance != kNoChunk && hidden[model.tree.instances[instance].placed.part];
            hidden_instances += is_hidden ? 1 : 0;
            return is_hidden;
        });
        ASSERT_EQ(cut_of(cut), expected);
    }
    EXPECT_GT(hidden_instances, many(200) / 2);
}

} // namespace
} // namespace abut::test
