/// The store gives back what read_scene gives, in any memory. A damaged file gives the same, or an
/// error.
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>

#include "core/external_sort.h"
#include "core/paged_array.h"
#include "mesh/topology.h"
#include "store/codec/mesh_codec.h"
#include "store/import/cut_mesh.h"
#include "store/import/mesh_draft.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/stores.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <set>
#include <unistd.h>

namespace abut::test {
namespace {

constexpr std::uint64_t kLittle = std::uint64_t{16} << 20;

float some_float(Random& random) {
    switch (random.integer(0, 5)) {
    case 0:
        return static_cast<float>(random.integer(-2, 2)) * 0.5F;
    case 1:
        return random.chance(0.5) ? -0.0F : 0.0F;
    case 2:
        return static_cast<float>(random.uniform(-1e17, 1e17));
    default:
        return static_cast<float>(random.uniform(-3, 3));
    }
}

/// Random triangles over few vertices, with equal positions, degenerate triangles and unused
/// vertices.
Mesh some_mesh(Random& random, int most) {
    Mesh mesh;
    const int vertices = random.integer(3, most);
    for (int i = 0; i < vertices; ++i)
        mesh.positions.push_back({some_float(random), some_float(random), some_float(random)});
    // One triangle has an area, because a file without any is refused.
    mesh.positions.push_back({1, 0, 0});
    mesh.positions.push_back({0, 1, 0});
    mesh.positions.push_back({0, 0, 1});
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    const auto corner = [&] {
        return static_cast<std::uint32_t>(random.integer(0, static_cast<int>(n) - 1));
    };
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
    for (int i = random.integer(0, most); i > 0; --i)
        mesh.triangles.push_back({corner(), corner(), corner()});
    return mesh;
}

std::string some_text(Random& random) {
    static const std::vector<std::string> kTexts{"",    "pipe",   "pipe#2",  "wall \"A\"", "Träger",
                                                 "a/b", "pipe#3", "x'); --", "node 0",     "slab"};
    return kTexts.at(
        static_cast<std::size_t>(random.integer(0, static_cast<int>(kTexts.size()) - 1)));
}

std::optional<Colour> some_colour(Random& random) {
    const auto byte = [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); };
    if (random.chance(0.3))
        return std::nullopt;
    return Colour{byte(), byte(), byte(), random.chance(0.7) ? std::uint8_t{255} : byte()};
}

Scene some_scene(Random& random, int most_parts) {
    Scene scene;
    for (int i = random.integer(1, 6); i > 0; --i)
        scene.meshes.push_back(random.chance(0.2) && !scene.meshes.empty() ? scene.meshes.front()
                                                                           : some_mesh(random, 40));
    for (int i = random.integer(1, most_parts); i > 0; --i) {
        Part part;
        part.id = some_text(random);
        part.name = some_text(random);
        part.type = some_text(random);
        part.mesh = static_cast<std::uint32_t>(
            random.integer(0, static_cast<int>(scene.meshes.size()) - 1));
        if (random.chance(0.7))
            part.world_from_mesh = random.pose(100);
        part.colour = some_colour(random);
        scene.parts.push_back(part);
    }
    return scene;
}

TEST(Store, GivesBackWhatReadSceneGives) {
    Random random(1);
    std::size_t shared = 0, repeated = 0, streamed = 0;
    const int rounds = many(60);
    for (int round = 0; round < rounds; ++round) {
        const Folder folder;
        write_glb(some_scene(random, 12), folder / "a.glb");
        ModelPath path{folder / "a.glb"};
        path.unit = random.chance(0.3) ? 0.001 : 0;
        if (random.chance(0.3))
            path.up = UpAxis::z;
        const Scene scene = read_scene(path);
        const ImportReport report =
            import_models(std::vector{path}, folder / "s.abut", {.memory = kLittle});
        streamed += report.models.at(0).streamed ? 1 : 0;
        ASSERT_EQ(report.models.at(0).added, scene.parts.size());
        expect_stored(folder / "s.abut", scene);
        ASSERT_EQ(folder.files(), 2U) << "something is left beside the store";
        verify(open_store(folder / "s.abut"));
        shared += report.new_meshes < scene.meshes.size() ? 1 : 0;
        repeated += std::any_of(scene.parts.begin(), scene.parts.end(), [](const Part& part) {
            return part.id.find('#') != std::string::npos;
        });
        if (HasFatalFailure())
            return;
    }
    EXPECT_EQ(streamed, static_cast<std::size_t>(rounds));
    EXPECT_GT(shared, 0U) << "no scene had equal meshes";
    EXPECT_GT(repeated, 0U) << "no scene had an id twice";
}

/// A bumpy sheet of 2 n^2 triangles in random order, whose vertices lie in rows and are partly
/// split.
Mesh sheet(Random& random, std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t k = 0; k <= n; ++k)
            mesh.positions.push_back({static_cast<float>(i), static_cast<float>(k),
                                      random.chance(0.9) ? some_float(random) : 0});
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = i * (n + 1) + k, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({d, c, b});
        }
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            if (random.chance(0.2)) {
                mesh.positions.push_back(mesh.positions[corner]);
                corner = static_cast<std::uint32_t>(mesh.positions.size() - 1);
            }
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937_64(random.bits()));
    // Unused vertices, sometimes more than one mesh block of them.
    for (int i = random.chance(0.5) ? 70000 : 3; i > 0; --i)
        mesh.positions.push_back({some_float(random), some_float(random), some_float(random)});
    return mesh;
}

std::vector<std::uint64_t> block_checksums(const std::string& store) {
    StoreFile file(store, true);
    std::vector<std::uint64_t> result;
    file.for_each_mesh([&](const MeshRow& mesh) {
        for (const BlockRow& block : file.blocks(mesh))
            result.push_back(block.data_checksum);
    });
    return result;
}

TEST(Store, OutOfCoreEqualsInCore) {
    Random random(2);
    std::size_t blocks = 0;
    for (int round = 0; round < many(4); ++round) {
        const Folder folder;
        Scene scene;
        scene.meshes = {sheet(random, static_cast<std::uint32_t>(random.integer(150, 300)))};
        for (const char* id : {"a", "b"})
            scene.parts.push_back({id, id, "", 0, random.pose(10)});
        write_glb(scene, folder / "a.glb");
        const Scene whole = read_scene(folder / "a.glb");
        import_models({folder / "a.glb"}, folder / "little.abut", {.memory = kLittle});
        import_models({folder / "a.glb"}, folder / "much.abut");
        expect_stored(folder / "little.abut", whole);
        expect_stored(folder / "much.abut", whole);
        EXPECT_EQ(block_checksums(folder / "little.abut"), block_checksums(folder / "much.abut"));
        verify(open_store(folder / "little.abut"));
        StoreFile little(folder / "little.abut", true), much(folder / "much.abut", true);
        const MeshRow out = little.mesh(1), in = much.mesh(1);
        // Only a mesh that is imported in core is tested for closedness.
        ASSERT_TRUE(!out.closed && in.closed) << "one of the two ways was not taken";
        EXPECT_EQ(out.hash_low, in.hash_low);
        EXPECT_EQ(out.box, in.box);
        blocks += out.blocks;
        Box3 box;
        std::uint64_t triangles = 0;
        for (const BlockRow& block : little.blocks(out)) {
            triangles += block.triangles;
            if (!(block.box.lower.x <= block.box.upper.x))
                continue;
            extend(box, block.box.lower);
            extend(box, block.box.upper);
        }
        EXPECT_EQ(box, out.box);
        EXPECT_EQ(triangles, out.triangles);
    }
    EXPECT_GT(blocks, 4U * 2) << "meshes were not cut";
}

TEST(Store, ReimportTouchesOnlyChanges) {
    Random random(3);
    std::size_t kept = 0, changed = 0;
    for (int round = 0; round < many(25); ++round) {
        const Folder folder;
        const std::string file = folder / "a.glb", store = folder / "s.abut";
        Scene before = some_scene(random, 15);
        write_glb(before, file);
        import_models({file}, store, {.memory = kLittle});
        const Scene first = read_scene(file);
        for (int again = 0; again < 3; ++again) {
            Scene after = before;
            // Poses, a type, a mesh and the order may change; a part may come or go.
            for (Part& part : after.parts)
                if (random.chance(0.15))
                    part.world_from_mesh = random.pose(100);
            if (random.chance(0.5))
                after.parts.front().type = "Changed " + std::to_string(again);
            if (random.chance(0.5))
                after.parts.back().colour = some_colour(random);
            if (random.chance(0.4))
                after.meshes.front() = some_mesh(random, 40);
            if (random.chance(0.4))
                after.parts.push_back({"new " + std::to_string(again), "", "", 0, {}});
            if (after.parts.size() > 1 && random.chance(0.4))
                after.parts.erase(after.parts.begin());
            if (random.chance(0.3))
                std::reverse(after.parts.begin(), after.parts.end());
            const Scene old = read_scene(file);
            write_glb(after, file);
            const Scene now = read_scene(file);
            std::map<std::string, const Part*> known;
            for (const Part& part : old.parts)
                known[part.id] = &part;
            std::uint64_t added = 0, differ = 0;
            std::vector<bool> is_new;
            for (const Part& part : now.parts) {
                const auto found = known.find(part.id);
                const bool fresh = found == known.end();
                const bool other =
                    !fresh &&
                    !(found->second->name == part.name && found->second->type == part.type &&
                      found->second->colour == part.colour &&
                      found->second->world_from_mesh == part.world_from_mesh &&
                      same_bits(old.meshes[found->second->mesh], now.meshes[part.mesh]));
                added += fresh ? 1 : 0;
                differ += other ? 1 : 0;
                is_new.push_back(fresh || other);
                known.erase(part.id);
            }
            const std::uint64_t removed = known.size();
            const std::uint64_t last = summary(open_store(store)).generation;
            const ImportReport report = import_models({file}, store, {.memory = kLittle});
            const ImportedModel& model = report.models.at(0);
            ASSERT_EQ(model.added, added);
            ASSERT_EQ(model.changed, differ);
            ASSERT_EQ(model.removed, removed);
            expect_stored(store, now);
            const StoreSummary found = summary(open_store(store));
            ASSERT_EQ(found.generation, last + (added + differ + removed > 0 ? 1 : 0));
            StoreFile content(store, true);
            const StoredScene stored = stored_scene(content, content.models().at(0));
            for (std::size_t i = 0; i < is_new.size(); ++i)
                ASSERT_EQ(stored.generations[i] == last + 1, is_new[i]) << now.parts[i].id;
            // A mesh that no part shows any more is removed.
            std::set<std::int64_t> shown;
            content.for_each_part([&](const PartRow& part) { shown.insert(part.mesh); });
            ASSERT_EQ(found.meshes, shown.size());
            verify(open_store(store));
            kept += static_cast<std::size_t>(std::count(is_new.begin(), is_new.end(), false));
            changed += added + differ + removed;
            before = after;
            if (HasFatalFailure())
                return;
        }
    }
    EXPECT_GT(kept, 20U);
    EXPECT_GT(changed, 20U);
}

TEST(Store, RemovesModelsCompletely) {
    Random random(6);
    std::size_t meshes = 0;
    for (int round = 0; round < many(10); ++round) {
        const Folder folder;
        const std::string store = folder / "s.abut";
        std::vector<std::string> files;
        std::vector<Scene> scenes;
        for (int i = 0; i < 3; ++i) {
            files.push_back(folder / ("m" + std::to_string(i) + ".glb"));
            write_glb(some_scene(random, 10), files.back());
            scenes.push_back(read_scene(files.back()));
            import_models({files.back()}, store, {.memory = kLittle});
        }
        const auto gone = static_cast<std::size_t>(random.integer(0, 2));
        EXPECT_THROW(remove_models({files[gone], folder / "none.glb"}, store), Error);
        EXPECT_THROW(remove_models({files[gone], files[gone]}, store), Error);
        EXPECT_EQ(summary(open_store(store)).models.size(), 3U);
        if (random.chance(0.5))
            std::filesystem::remove(files[gone]);
        const RemovalReport report = remove_models({files[gone]}, store);
        ASSERT_EQ(report.models.at(0).parts, scenes[gone].parts.size());
        meshes += report.removed_meshes;
        verify(open_store(store));
        const std::uint64_t parts = summary(open_store(store)).parts;
        scenes.erase(scenes.begin() + static_cast<std::ptrdiff_t>(gone));
        files.erase(files.begin() + static_cast<std::ptrdiff_t>(gone));
        ASSERT_EQ(parts, scenes[0].parts.size() + scenes[1].parts.size());
        for (std::size_t m = 0; m < 2; ++m)
            expect_stored(store, scenes[m], m);
        // Generations keep counting even if some or all models were removed.
        if (random.chance(0.5)) {
            (void)remove_models(files, store);
            ASSERT_EQ(summary(open_store(store)).meshes, 0U);
        }
        write_glb(some_scene(random, 10), folder / "new.glb");
        import_models({folder / "new.glb"}, store, {.memory = kLittle});
        ASSERT_EQ(summary(open_store(store)).generation, 4U);
    }
    EXPECT_GT(meshes, 0U);
}

std::string read_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Reads all that a clash job would.
void read_all(const std::string& store, const Scene& scene) {
    StoreFile file(store, true);
    for (const ModelRow& model : file.models())
        expect_same_scene(scene, stored_scene(file, model).scene);
}

TEST(Store, DamageIsNeverAWrongAnswer) {
    Random random(4);
    std::size_t found = 0, harmless = 0, verified = 0, silent = 0;
    for (int round = 0; round < many(6); ++round) {
        const Folder folder;
        const std::string store = folder / "s.abut";
        write_glb(some_scene(random, 40), folder / "a.glb");
        const Scene scene = read_scene(folder / "a.glb");
        import_models({folder / "a.glb"}, store, {.memory = kLittle});
        const std::string whole = read_bytes(store);
        for (int trial = 0; trial < 60; ++trial) {
            std::string bytes = whole;
            const auto place = [&] { return random.bits() % bytes.size(); };
            if (random.chance(0.2))
                bytes.resize(place());
            else if (random.chance(0.2))
                std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2),
                            std::min<std::size_t>(bytes.size() / 2, 4096), '\0');
            else
                for (int flips = random.integer(1, 3); flips > 0; --flips)
                    bytes[place()] ^= static_cast<char>(1 << random.integer(0, 7));
            std::ofstream(store, std::ios::binary | std::ios::trunc) << bytes;
            try {
                read_all(store, scene);
                ++harmless; // the damage is in a page that was not read
                if (HasFatalFailure())
                    return;
                try {
                    verify(open_store(store));
                    ++silent;
                } catch (const Error&) {
                    ++verified;
                }
            } catch (const Error& error) {
                ++found;
                ASSERT_EQ(std::string(error.what()).rfind(store + ": ", 0), 0U) << error.what();
                ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            }
        }
    }
    std::cout << found << " found, " << harmless << " harmless, of these " << verified
              << " found by verify and " << silent << " in unused bytes\n";
    EXPECT_GT(found, harmless / 4);
    EXPECT_GT(harmless, 0U);
}

TEST(Store, AnotherTextInTheColumnOfColoursIsDamage) {
    Random random(12);
    const Folder folder;
    const std::string file = folder / "a.glb", store = folder / "s.abut";
    Scene scene = some_scene(random, 1);
    for (const std::optional<Colour>& colour :
         {std::optional<Colour>(), std::optional(Colour{255, 0, 0})}) {
        scene.parts[0].colour = colour;
        write_glb(scene, file);
        import_models({file}, store, {.memory = kLittle});
        verify(open_store(store));
        const auto set = [&](const std::string& text) {
            Database(store, OpenMode::read_write)
                .run(("UPDATE part SET colour = '" + text + "'").c_str());
        };
        for (const std::string text : {"#fe0000", "#ff0000ff", "#FF0000", "ff0000", "#ff000", "#",
                                       "#ff00001", "#ff000080", "#ff0000000", "red", " "}) {
            set(text);
            EXPECT_THROW(verify(open_store(store)), Error) << text;
        }
        set(colour ? "" : "#000000");
        EXPECT_THROW(verify(open_store(store)), Error);
        set(colour ? "#ff0000" : "");
        verify(open_store(store));
    }
}

TEST(MeshCodec, IsLossless) {
    Random random(5);
    std::size_t doubles = 0;
    for (int round = 0; round < many(300); ++round) {
        MeshBlock block;
        block.mesh = some_mesh(random, 60);
        if (random.chance(0.5)) {
            ++doubles;
            for (Vec3& p : block.mesh.positions)
                p = {p.x + 1e-12, random.uniform(-1e300, 1e300), -0.0};
        }
        if (random.chance(0.5)) {
            std::uint32_t id = 0;
            for (std::size_t i = 0; i < block.mesh.positions.size(); ++i)
                block.vertex_ids.push_back(
                    id += static_cast<std::uint32_t>(random.integer(1, 100'000'000)) % 50000000);
            std::sort(block.vertex_ids.begin(), block.vertex_ids.end());
            block.vertex_ids.erase(std::unique(block.vertex_ids.begin(), block.vertex_ids.end()),
                                   block.vertex_ids.end());
            if (block.vertex_ids.size() != block.mesh.positions.size())
                block.vertex_ids.clear();
            else
                for (std::size_t i = 0; i < block.mesh.triangles.size(); ++i)
                    block.triangle_ids.push_back(static_cast<std::uint32_t>(3 * i));
        }
        const EncodedBlock encoded = encode_block(block);
        const MeshBlock decoded = decode_block(encoded.data, encoded.raw_bytes);
        ASSERT_TRUE(same_bits(block.mesh, decoded.mesh));
        ASSERT_EQ(block.vertex_ids, decoded.vertex_ids);
        ASSERT_EQ(block.triangle_ids, decoded.triangle_ids);
    }
    EXPECT_GT(doubles, 0U);
}

TEST(MeshDraft, ClosednessEqualsThatOfTheTopology) {
    Random random(6);
    std::size_t closed = 0;
    const int rounds = many(400);
    for (int round = 0; round < rounds; ++round) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
        mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        for (int i = random.integer(0, 2); i > 0; --i) {
            const auto corner = [&] { return static_cast<std::uint32_t>(random.integer(0, 4)); };
            if (random.chance(0.3))
                mesh.triangles.pop_back();
            else
                mesh.triangles.push_back({corner(), corner(), corner()});
        }
        const bool expected = is_closed(make_topology(mesh));
        ASSERT_EQ(is_closed_joined(mesh), expected);
        closed += expected ? 1 : 0;
    }
    EXPECT_GT(closed, static_cast<std::size_t>(rounds) / 10);
    EXPECT_LT(closed, static_cast<std::size_t>(rounds) / 10 * 9);
}

TEST(ExternalSort, EqualsSortingInMemory) {
    Random random(7);
    for (int round = 0; round < many(10); ++round) {
        const Folder folder;
        ExternalSort<std::uint64_t> sort(folder / "", 8192);
        std::vector<std::uint64_t> expected;
        for (int i = random.integer(0, 1) * random.integer(0, 20000); i >= 0; --i) {
            expected.push_back(random.bits());
            sort.push(expected.back());
        }
        std::sort(expected.begin(), expected.end());
        std::vector<std::uint64_t> sorted;
        sort.drain([&](std::uint64_t value) { sorted.push_back(value); });
        ASSERT_EQ(sorted, expected);
        ASSERT_EQ(folder.files(), 0U);
    }
}

TEST(PagedArray, EqualsAnArrayInMemory) {
    Random random(8);
    const Folder folder;
    constexpr int kCount = 200000;
    PagedArray<std::uint32_t> paged(folder / "", kCount, 40000);
    std::vector<std::uint32_t> expected(kCount);
    for (int i = 0; i < many(50000); ++i) {
        const auto at = static_cast<std::size_t>(random.integer(0, kCount - 1));
        ASSERT_EQ(paged.get(at), expected[at]);
        expected[at] = static_cast<std::uint32_t>(i);
        paged.set(at, expected[at]);
    }
}

} // namespace
} // namespace abut::test
