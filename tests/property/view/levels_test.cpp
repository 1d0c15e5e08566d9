// Levels of detail in a store: every chunk stays within its error of the full geometry, full detail
// shows every part, and the result depends neither on threads nor on interruptions.

#include <abut/error.h>
#include <abut/levels.h>
#include <abut/model.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>

#include "core/disjoint_sets.h"
#include "geometry/point_triangle_distance.h"
#include "scenes/plant/plant.h"
#include "store/database/level_table.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/shapes.h"
#include "view/levels/level_tree.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace abut::test {
namespace {

std::string store_of(const Scene& scene, const Folder& folder, const std::string& name = "a") {
    write_glb(scene, folder / (name + ".glb"));
    (void)import_models({folder / (name + ".glb")}, folder / (name + ".abut"));
    return folder / (name + ".abut");
}

Scene plant_scene(std::uint64_t triangles, bool distinct) {
    PlantOptions options;
    options.triangles = triangles;
    options.clashes = 5;
    options.distinct = distinct;
    return make_plant(options).scene;
}

/// Everything that is hard: soups, degenerate triangles, mirrored and sheared places, tiny and huge
/// parts, parts far from the origin, shared meshes, and a mesh that is cut into blocks.
Scene rough_scene(Random& random, bool far) {
    Scene scene;
    const double shift = far ? 1e6 : 0;
    const auto add = [&](Mesh mesh, int times) {
        scene.meshes.push_back(std::move(mesh));
        for (int i = 0; i < times; ++i) {
            Transform place = random.linear_map(random.chance(0.3));
            const Vec3 at = random.in_cube(20);
            place.m[9] = at.x + shift, place.m[10] = at.y - shift, place.m[11] = at.z;
            const std::string id = "part " + std::to_string(scene.parts.size());
            scene.parts.push_back(
                {id, id, "", static_cast<std::uint32_t>(scene.meshes.size() - 1), place});
        }
    };
    add(torus_mesh(5, 2, 300, 125), 1); // cut into blocks
    add(sphere_mesh(1.5, 40, 30), 8);
    add(torus_mesh(0.5, 0.1, 30, 12), 20);
    for (int i = 0; i < reduced_for_threads(60, 10); ++i)
        add(with_degenerates(random, sphere_mesh(random.uniform(0.001, 2), 12, 9), 5), 1);
    for (int i = 0; i < reduced_for_threads(40, 6); ++i)
        add(soup_mesh(random, 200, random.uniform(0.1, 1), 0.3), 1);
    for (int i = 0; i < reduced_for_threads(300, 60); ++i)
        add(box_mesh({0, 0, 0}, {random.uniform(0.001, 0.2), 0.1, random.uniform(0.1, 4)}), 1);
    return scene;
}

Mesh placed_mesh(Mesh mesh, const Transform& place, const Vec3& origin) {
    for (Vec3& p : mesh.positions)
        p = apply(place, p) - origin;
    return mesh;
}

/// Distances to a surface that may be flat or empty, by all triangles or by a Model.
class Surface {
public:
    explicit Surface(Mesh mesh) : mesh_(std::move(mesh)) {
        if (mesh_.triangles.size() > 100 && !inspect_flat())
            model_ = std::make_unique<Model>(mesh_);
    }
    [[nodiscard]] double distance(const Vec3& p) const {
        if (model_ != nullptr)
            return nearest(*model_, Pose(), p).distance;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : mesh_.triangles)
            least = std::min(least, nearest_on_triangle(p, {mesh_.positions[a], mesh_.positions[b],
                                                            mesh_.positions[c]})
                                        .distance_sq);
        return std::sqrt(least);
    }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
    [[nodiscard]] bool inspect_flat() const {
        const MeshReport report = inspect(mesh_);
        return report.degenerate_triangles == report.triangles;
    }
    Mesh mesh_;
    std::unique_ptr<Model> model_;
};

/// A store's levels with its full geometry, all relative to the tree's origin.
struct Levels {
    explicit Levels(const std::string& path) : store(open_store(path)) {
        tree = read_level_tree(store.file());
        store.file().for_each_part([&](const PartRow& part) {
            rows[part.part] = part;
            const auto found = std::lower_bound(tree.parts.begin(), tree.parts.end(), part.part);
            EXPECT_TRUE(found != tree.parts.end() && *found == part.part);
        });
        EXPECT_EQ(rows.size(), tree.parts.size());
    }
    [[nodiscard]] Mesh full(std::uint32_t part) {
        const PartRow& row = rows.at(tree.parts[part]);
        return placed_mesh(store.file().read_mesh(row.mesh), row.world_from_mesh, tree.origin);
    }
    /// The triangles of a chunk, by part.
    std::map<std::uint32_t, Mesh> drawn(std::uint32_t number) {
        const ViewChunk chunk = read_level_chunk(store.file(), tree, number);
        EXPECT_LE(chunk.vertices.size(), 65536U);
        EXPECT_EQ(chunk.vertices.size(), tree.chunks[number].vertices);
        EXPECT_EQ(chunk.indices.size(), 3 * std::size_t{tree.chunks[number].triangles});
        std::map<std::uint32_t, Mesh> by_part;
        for (std::size_t i = 0; i < chunk.indices.size(); i += 3) {
            Mesh& mesh = by_part[chunk.vertices[chunk.indices[i]].part];
            const auto base = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::size_t k = 0; k < 3; ++k) {
                const ChunkVertex& v = chunk.vertices[chunk.indices[i + k]];
                EXPECT_EQ(v.part, chunk.vertices[chunk.indices[i]].part);
                const auto at = [&](std::size_t a) {
                    return double{chunk.lower.at(a) + chunk.step.at(a) * float(v.position.at(a))};
                };
                mesh.positions.push_back({at(0), at(1), at(2)});
            }
            mesh.triangles.push_back({base, base + 1, base + 2});
        }
        return by_part;
    }

    Store store;
    LevelTree tree;
    std::map<std::int64_t, PartRow> rows;
};

/// Corners, centres and random points of triangles, at most about `most` of them.
template <typename Take>
void sample(Random& random, const Mesh& mesh, std::size_t most, const Take& take) {
    const std::size_t stride = std::max<std::size_t>(4 * mesh.triangles.size() / most, 1);
    for (std::size_t i = static_cast<std::size_t>(random.integer(0, static_cast<int>(stride) - 1));
         i < mesh.triangles.size(); i += stride) {
        const auto& t = mesh.triangles[i];
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        take(a, i);
        take((1.0 / 3) * (a + b + c), i);
        for (int k = 0; k < 2; ++k) {
            double u = random.uniform(0, 1), v = random.uniform(0, 1);
            if (u + v > 1)
                u = 1 - u, v = 1 - v;
            take(a + u * (b - a) + v * (c - a), i);
        }
    }
}

/// For each triangle, the least triangle that is connected with it through equal positions.
std::vector<std::uint32_t> components(const Mesh& mesh) {
    DisjointSets sets(mesh.triangles.size());
    std::map<std::array<double, 3>, std::uint32_t> first;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t v : mesh.triangles[i]) {
            const Vec3& p = mesh.positions[v];
            sets.unite(i, first.try_emplace({p.x, p.y, p.z}, i).first->second);
        }
    return std::move(sets).roots();
}

struct BoundTally {
    std::uint64_t samples = 0, left_out = 0, resting = 0;
    std::uint64_t nodes = 0, tight = 0; ///< tight: a sample comes to a third of the error
};

/// Compares a coarse mesh of a part with the full one, both ways. What is left out of the part may be
/// near to another part of the chunk.
void expect_within(Random& random, const Surface& full, const Surface& coarse,
                   const Surface& whole_chunk, double error, const std::string& where,
                   BoundTally& tally, double& largest) {
    const double most = error * (1 + 1e-9) + 1e-12;
    sample(random, coarse.mesh(), 100, [&](const Vec3& p, std::size_t) {
        const double found = full.distance(p);
        largest = std::max(largest, found);
        ASSERT_LE(found, most) << where;
        ++tally.samples;
    });
    const std::vector<std::uint32_t> component = components(full.mesh());
    std::map<std::uint32_t, Box3> missing; // by component: what is farther than the error
    sample(random, full.mesh(), 100, [&](const Vec3& p, std::size_t triangle) {
        double found = coarse.distance(p);
        const bool is_near = found <= most;
        if (!is_near)
            found = whole_chunk.distance(p);
        ++tally.samples;
        if (found > most)
            extend(missing[component[triangle]], p);
        else
            largest = std::max(largest, found);
        tally.resting += found <= most && !is_near ? 1 : 0;
    });
    for (const auto& [number, box] : missing) {
        ASSERT_LE(length(box.upper - box.lower), most) << where << ": component " << number;
        ++tally.left_out;
    }
}

/// The meshes below a node by part, at full detail. Parts whose mesh is cut have only what the
/// leaves below show.
class BelowNode {
public:
    BelowNode(Levels& levels) : levels_(levels), leaves_of_(levels.tree.parts.size(), 0) {
        for (const LevelNode& node : levels.tree.nodes)
            if (node.children == 0)
                for (const std::uint32_t part : parts_of(node))
                    ++leaves_of_[part];
    }
    std::map<std::uint32_t, Mesh> full(std::uint32_t node) {
        std::map<std::uint32_t, int> found;
        std::map<std::uint32_t, Mesh> cut;
        visit(node, found, cut);
        std::map<std::uint32_t, Mesh> result;
        for (const auto& [part, leaves] : found)
            result[part] = leaves == leaves_of_[part] ? levels_.full(part) : cut.at(part);
        return result;
    }

private:
    std::set<std::uint32_t> parts_of(const LevelNode& leaf) {
        if (leaf.instance != kNoChunk)
            return {levels_.tree.instances[leaf.instance].placed.part};
        std::set<std::uint32_t> parts;
        if (leaf.chunk != kNoChunk)
            for (const auto& [part, mesh] : levels_.drawn(leaf.chunk))
                parts.insert(part);
        return parts;
    }
    void visit(std::uint32_t number, std::map<std::uint32_t, int>& found,
               std::map<std::uint32_t, Mesh>& cut) {
        const LevelNode& node = levels_.tree.nodes[number];
        for (std::uint32_t k = 0; k < node.children; ++k)
            visit(node.first_child + k, found, cut);
        if (node.children > 0)
            return;
        for (const std::uint32_t part : parts_of(node)) {
            ++found[part];
            if (leaves_of_[part] > 1)
                cut[part] = joined(cut[part], levels_.drawn(node.chunk).at(part));
        }
    }
    Levels& levels_;
    std::vector<int> leaves_of_;
};

void expect_bounds(const std::string& path, std::uint64_t seed) {
    Random random(seed);
    Levels levels(path);
    BelowNode below(levels);
    BoundTally tally;
    const LevelTree& tree = levels.tree;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const LevelNode& node = tree.nodes[i];
        if (node.children == 0 || node.chunk == kNoChunk)
            continue;
        std::map<std::uint32_t, Mesh> coarse = levels.drawn(node.chunk);
        double largest = 0;
        Mesh all;
        for (const auto& [part, mesh] : coarse)
            all = joined(all, mesh);
        const Surface whole(std::move(all));
        for (auto& [part, mesh] : below.full(i)) {
            const Surface full(std::move(mesh));
            expect_within(random, full, Surface(coarse[part]), whole, double{node.error},
                          "node " + std::to_string(i) + " part " + std::to_string(part), tally,
                          largest);
            if (testing::Test::HasFatalFailure())
                return;
            coarse.erase(part);
        }
        EXPECT_TRUE(coarse.empty()) << "node " << i << " shows parts that are not below it";
        ++tally.nodes;
        tally.tight += 3 * largest > double{node.error} ? 1 : 0;
    }
    for (const LevelInstance& instance : tree.instances) {
        const LevelMesh& mesh = tree.meshes[instance.mesh];
        const Surface full(levels.full(instance.placed.part));
        double largest = 0;
        for (std::uint32_t k = 0; k < mesh.levels; ++k) {
            const MeshLevel& level = tree.mesh_levels[mesh.first_level + k];
            const auto& r = instance.placed.rows;
            const Transform place(
                {r[0], r[4], r[8], r[1], r[5], r[9], r[2], r[6], r[10], r[3], r[7], r[11]});
            std::map<std::uint32_t, Mesh> drawn = levels.drawn(level.chunk);
            const Surface coarse(placed_mesh(drawn[0], place, {}));
            // Full detail is rounded to its grid, and instances are placed in single precision.
            const double rounding = 2e-4;
            expect_within(random, full, coarse, coarse,
                          double{instance.scale} * double{level.error} + rounding, "instance",
                          tally, largest);
            if (testing::Test::HasFatalFailure())
                return;
        }
    }
    std::cout << tally.samples << " samples, " << tally.left_out << " pieces left out, "
              << tally.resting << " samples of parts that rest on others, " << tally.tight << " of "
              << tally.nodes << " nodes come to a third of their error\n";
    EXPECT_GT(tally.samples, 10'000U);
    EXPECT_GT(2 * tally.tight, tally.nodes);
}

void expect_sound_tree(const std::string& path) {
    Levels levels(path);
    const LevelTree& tree = levels.tree;
    std::map<std::uint32_t, std::uint64_t> triangles;
    std::vector<int> parents(tree.nodes.size(), 0);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const LevelNode& node = tree.nodes[i];
        for (std::uint32_t k = 0; k < node.children; ++k) {
            const LevelNode& child = tree.nodes[node.first_child + k];
            ASSERT_GT(node.first_child + k, i);
            ++parents[node.first_child + k];
            EXPECT_LE(child.error, node.error);
            for (std::size_t a = 0; a < 3; ++a) {
                EXPECT_LE(node.lower.at(a), child.lower.at(a));
                EXPECT_GE(node.upper.at(a), child.upper.at(a));
            }
        }
        if (node.chunk != kNoChunk)
            for (const auto& [part, mesh] : levels.drawn(node.chunk)) {
                for (const Vec3& p : mesh.positions)
                    for (int a = 0; a < 3; ++a) {
                        ASSERT_LE(double{node.lower.at(std::size_t(a))}, component(p, a));
                        ASSERT_GE(double{node.upper.at(std::size_t(a))}, component(p, a));
                    }
                if (node.children == 0)
                    triangles[part] += mesh.triangles.size();
            }
        if (node.children == 0) {
            EXPECT_EQ(node.error, 0);
            EXPECT_NE(node.chunk == kNoChunk, node.instance == kNoChunk);
        }
        if (node.instance != kNoChunk) {
            const LevelInstance& instance = tree.instances[node.instance];
            const LevelMesh& mesh = tree.meshes[instance.mesh];
            const MeshLevel& finest = tree.mesh_levels[mesh.first_level + mesh.levels - 1];
            EXPECT_EQ(finest.error, 0);
            triangles[instance.placed.part] += tree.chunks[finest.chunk].triangles;
        }
    }
    for (std::size_t i = 1; i < parents.size(); ++i)
        EXPECT_EQ(parents[i], 1);
    for (std::uint32_t i = 0; i < tree.parts.size(); ++i)
        EXPECT_EQ(triangles[i], levels.full(i).triangles.size()) << "part " << i;
}

TEST(Levels, ErrorsHoldInAPlant) {
    for (const bool distinct : {false, true}) {
        const Folder folder;
        const std::string store =
            store_of(plant_scene(reduced_for_threads(60'000U, 12'000U), distinct), folder);
        const LevelReport report = build_levels(store);
        EXPECT_TRUE(report.built);
        EXPECT_TRUE(has_levels(open_store(store)));
        expect_sound_tree(store);
        expect_bounds(store, 1);
        verify(open_store(store));
        if (distinct) {
            EXPECT_LE(report.stored_bytes, report.geometry_bytes * 3 / 2);
        }
        EXPECT_FALSE(build_levels(store).built);
    }
}

TEST(Levels, ErrorsHoldForRoughModels) {
    const int rounds = many(reduced_for_threads(2, 1));
    for (int round = 0; round < rounds; ++round) {
        const Folder folder;
        Random random(static_cast<std::uint64_t>(round) + 10);
        const std::string store = store_of(rough_scene(random, round % 2 == 1), folder);
        (void)build_levels(store);
        expect_sound_tree(store);
        expect_bounds(store, 2);
    }
}

/// All of the levels, with chunks by content instead of by number.
struct Content {
    std::map<std::string, std::string> chunks;
    std::string tree;
    friend bool operator==(const Content&, const Content&) = default;
};

Content content_of(const std::string& path) {
    Content content;
    Levels levels(path);
    Database database(path, OpenMode::read_only);
    Statement rows(database, "SELECT hex(key), hex(data), chunk FROM level_chunk");
    std::map<std::int64_t, std::string> key_of;
    while (rows.step()) {
        content.chunks[rows.text(0)] = rows.text(1);
        key_of[rows.integer(2)] = rows.text(0);
    }
    for (const LevelNode& node : levels.tree.nodes) {
        const auto* bytes = reinterpret_cast<const char*>(&node);
        content.tree.append(bytes, sizeof node);
    }
    for (const std::int64_t row : levels.tree.chunk_rows)
        content.tree += key_of.at(row);
    return content;
}

TEST(Levels, AreTheSameWithAnyThreads) {
    const Folder folder;
    Random random(3);
    const Scene scene = rough_scene(random, false);
    const std::string one = store_of(scene, folder, "one"), all = store_of(scene, folder, "all");
    set_threads(1);
    (void)build_levels(one);
    set_threads(4);
    (void)build_levels(all, {.memory = std::uint64_t{64} << 20});
    set_threads(0);
    EXPECT_EQ(content_of(one), content_of(all));
}

TEST(Levels, AreContinued) {
    const Folder folder;
    const Scene scene = plant_scene(reduced_for_threads(100'000U, 30'000U), true);
    const std::string whole = store_of(scene, folder, "whole"),
                      parts = store_of(scene, folder, "parts");
    const LevelReport report = build_levels(whole);
    std::uint64_t before = 0;
    int stops = 0;
    for (double until = 0.1; until < 0.6; until += 0.1) {
        std::atomic<bool> stop = false;
        LevelOptions options;
        options.progress.stop = &stop;
        options.progress.report = [&](std::string_view, double fraction) {
            if (fraction >= until)
                stop = true;
        };
        try {
            (void)build_levels(parts, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::interrupted);
            ++stops;
        }
        EXPECT_FALSE(has_levels(open_store(parts)));
        EXPECT_THROW((void)read_level_tree(open_store(parts).file()), Error);
        Database database(parts, OpenMode::read_only);
        const auto chunks =
            static_cast<std::uint64_t>(database.number("SELECT count(*) FROM level_chunk"));
        EXPECT_GE(chunks, before);
        before = chunks;
    }
    EXPECT_EQ(stops, 5);
    EXPECT_GT(before, 0U);
    const LevelReport rest = build_levels(parts);
    EXPECT_EQ(rest.new_chunks + before, report.chunks);
    EXPECT_EQ(content_of(whole), content_of(parts));
}

TEST(Levels, AreReusedAfterAChange) {
    const Folder folder;
    Scene scene = plant_scene(60'000U, true);
    const std::string store = store_of(scene, folder);
    const LevelReport first = build_levels(store);
    const std::string model = folder / "a.glb";
    scene.parts[scene.parts.size() / 4].world_from_mesh.m[9] += 0.25;
    scene.parts.erase(scene.parts.begin() + std::ptrdiff_t(scene.parts.size() / 2));
    write_glb(scene, model);
    (void)import_models({model}, store);
    EXPECT_FALSE(has_levels(open_store(store)));
    EXPECT_THROW((void)read_level_tree(open_store(store).file()), Error);
    const LevelReport second = build_levels(store);
    EXPECT_TRUE(second.built);
    std::cout << second.new_chunks << " of " << second.chunks << " chunks are new\n";
    EXPECT_LE(second.new_chunks, first.chunks / 4);
    EXPECT_GE(second.new_chunks, 2U);
    // As if the changed file had been imported at once; parts have other numbers then.
    const LevelReport fresh = build_levels(store_of(scene, folder, "fresh"));
    EXPECT_EQ(fresh.chunks, second.chunks);
    EXPECT_EQ(fresh.triangles, second.triangles);
    expect_sound_tree(store);
}

TEST(Levels, OfAnotherFormatAreOutdated) {
    const Folder folder;
    const std::string store = store_of(plant_scene(30'000, true), folder);
    (void)build_levels(store);
    const Content first = content_of(store);
    {
        Database database(store, OpenMode::read_write);
        Transaction transaction(database);
        const Hash128 earlier = level_content(open_store(store).file().models(), kLevelFormat - 1);
        replace_level_tree(database, {earlier, std::vector<std::byte>(100, std::byte{7})}, {});
        transaction.commit();
    }
    EXPECT_FALSE(has_levels(open_store(store)));
    EXPECT_FALSE(summary(open_store(store)).levels);
    verify(open_store(store)); // nothing is damaged
    try {
        (void)read_level_tree(open_store(store).file());
        FAIL() << "the levels are outdated";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument) << error.what();
    }
    EXPECT_TRUE(build_levels(store).built);
    EXPECT_EQ(content_of(store), first);
}

TEST(Levels, DamageIsAnError) {
    const Folder folder;
    const std::string store = store_of(plant_scene(30'000, true), folder);
    (void)build_levels(store);
    {
        Levels levels(store);
        Database database(store, OpenMode::read_write);
        database.run("UPDATE level_chunk SET data = CAST(substr(data, 1, 99) || x'5a' || "
                     "substr(data, 101) AS BLOB)");
        for (std::uint32_t i = 0; i < levels.tree.chunks.size(); ++i)
            EXPECT_THROW((void)read_level_chunk(levels.store.file(), levels.tree, i), Error);
        EXPECT_THROW(verify(levels.store), Error);
    }
    Database(store, OpenMode::read_write)
        .run("UPDATE level_tree SET data = CAST(substr(data, 1, 49) || x'5a' || "
             "substr(data, 51) AS BLOB)");
    try {
        (void)read_level_tree(open_store(store).file());
        FAIL() << "the tree is damaged";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::malformed);
        EXPECT_TRUE(std::string(error.what()).find(store) != std::string::npos);
    }
}

TEST(Levels, OfAnEmptyStore) {
    const Folder folder;
    const std::string store = store_of(plant_scene(10'000, true), folder);
    (void)remove_models({folder / "a.glb"}, store);
    EXPECT_TRUE(build_levels(store).built);
    const Levels levels(store);
    ASSERT_EQ(levels.tree.nodes.size(), 1U);
    EXPECT_EQ(levels.tree.nodes[0].chunk, kNoChunk);
    EXPECT_EQ(levels.tree.nodes[0].children, 0U);
    EXPECT_TRUE(levels.tree.parts.empty());
}

TEST(Levels, NeedMemoryAndAStore) {
    const Folder folder;
    const std::string store = store_of(plant_scene(10'000, false), folder);
    EXPECT_THROW((void)build_levels(store, {.memory = 1000}), Error);
    EXPECT_THROW((void)build_levels(folder / "none.abut"), Error);
    EXPECT_THROW((void)build_levels(folder / "a.glb"), Error);
    EXPECT_FALSE(has_levels(open_store(store)));
    const Store reader = open_store(store);
    reader.file().with_connection([&](Database& database) {
        database.run("BEGIN");
        (void)database.number("SELECT count(*) FROM part");
        EXPECT_THROW((void)build_levels(store), Error); // in use
        database.run("COMMIT");
    });
    EXPECT_TRUE(build_levels(store).built);
}

} // namespace
} // namespace abut::test
