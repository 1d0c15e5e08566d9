/// Colours of parts, of models in memory and of a store. No OpenGL is needed.
#include <abut/error.h>
#include <abut/picture.h>
#include <abut/store_clash.h>

#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Four boxes on two storeys; the last one has none, and is apart. The first two overlap, the third
/// touches the second.
Scene storeys_scene(const std::string& file) {
    Scene scene;
    scene.file = file;
    scene.up = UpAxis::y;
    const std::array<Box3, 4> boxes{Box3{{0, 0, 0}, {1, 1, 1}}, Box3{{0.5, 0, 0}, {2, 1, 1}},
                                    Box3{{2, 0, 0}, {3, 1, 1}}, Box3{{9, 0, 0}, {10, 1, 1}}};
    const std::array<const char*, 4> storeys{"Level 1", "Level 2", "Level 1", ""};
    const std::array<const char*, 4> types{"Wall", "Pipe", "Pipe", "Pipe"};
    PropertiesBuilder properties;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        scene.meshes.push_back(box_mesh(boxes.at(i).lower, boxes.at(i).upper));
        scene.parts.push_back({"part" + std::to_string(i), "Part", types.at(i), i, {}, {}});
        properties.add("storey", storeys.at(i)); // an empty value counts as none
        properties.next_part();
    }
    scene.properties = properties.finish(boxes.size());
    return scene;
}

std::vector<std::string> words_of_parts(const PartColouring& colouring) {
    std::vector<std::string> words;
    for (const std::uint32_t group : colouring.groups)
        words.push_back(colouring.legend.at(group).word);
    return words;
}

std::vector<std::uint64_t> sizes_of_groups(const PartColouring& colouring) {
    std::vector<std::uint64_t> sizes;
    for (const PartColouring::Group& group : colouring.legend)
        sizes.push_back(group.parts);
    return sizes;
}

/// Equal words have equal colours, different ones different, and they are those of the legend.
void expect_colours_of_words(const PartColouring& colouring) {
    const std::vector<std::string> words = words_of_parts(colouring);
    ASSERT_EQ(words.size(), colouring.colours.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        EXPECT_EQ(colouring.colours[i], colouring.legend[colouring.groups[i]].colour);
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_EQ(words[i] == words[k], colouring.colours[i] == colouring.colours[k])
                << words[i] << ", " << words[k];
    }
}

TEST(PartColours, OfModelsInMemoryAreByStoreyTypeAndFile) {
    std::vector<Scene> models{storeys_scene("a.glb"), storeys_scene("b.glb")};
    models[1].parts.resize(1); // a scene may state properties of fewer parts
    const PartColouring storeys = part_colouring(models, ColourBy::storey);
    EXPECT_EQ(words_of_parts(storeys),
              (std::vector<std::string>{"Level 1", "Level 2", "Level 1", "none", "Level 1"}));
    EXPECT_EQ(sizes_of_groups(storeys), (std::vector<std::uint64_t>{3, 1, 1}));
    expect_colours_of_words(storeys);
    const PartColouring types = part_colouring(models, ColourBy::type);
    EXPECT_EQ(words_of_parts(types),
              (std::vector<std::string>{"Wall", "Pipe", "Pipe", "Pipe", "Wall"}));
    EXPECT_EQ(types.legend.front().word, "Pipe");
    expect_colours_of_words(types);
    const PartColouring files = part_colouring(models, ColourBy::file);
    EXPECT_EQ(sizes_of_groups(files), (std::vector<std::uint64_t>{4, 1}));
    expect_colours_of_words(files);
    // Without a legend: materials, and parts.
    models[0].parts[0].colour = Colour{1, 2, 3};
    EXPECT_EQ(part_colours(models, ColourBy::material).front(), (Colour{1, 2, 3}));
    EXPECT_EQ(part_colours(models, ColourBy::part).size(), 5U);
    EXPECT_TRUE(part_colouring(models, ColourBy::part).legend.empty());
}

TEST(PartColours, OfModelsInMemoryCannotBeByClash) {
    try {
        (void)part_colours({storeys_scene("a.glb")}, ColourBy::clash);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()).find("store"), std::string::npos) << error.what();
    }
}

TEST(PartColours, OfAStoreAreThoseOfItsModels) {
    const Folder folder;
    const std::string file = folder / "a.glb", path = folder / "a.abut";
    write_glb(storeys_scene("a.glb"), file);
    import_models({file}, path);
    const std::vector<Scene> models = read_scenes(std::vector{file});
    const Store store = open_store(path);
    for (const ColourBy by :
         {ColourBy::storey, ColourBy::type, ColourBy::file, ColourBy::part, ColourBy::material}) {
        const PartColouring stored = part_colouring(store, by), read = part_colouring(models, by);
        EXPECT_EQ(stored.colours, read.colours) << to_string(by);
        EXPECT_EQ(words_of_parts(stored), words_of_parts(read)) << to_string(by);
        EXPECT_EQ(part_colours(store, by), stored.colours);
    }
    EXPECT_EQ(words_of_parts(part_colouring(store, ColourBy::storey)),
              (std::vector<std::string>{"Level 1", "Level 2", "Level 1", "none"}));
}

TEST(PartColours, ByClashAreTheWorstOfEachPart) {
    const Folder folder;
    const std::string file = folder / "a.glb", path = folder / "a.abut";
    write_glb(storeys_scene("a.glb"), file);
    import_models({file}, path);
    const Store store = open_store(path, {.read_only = false});
    EXPECT_EQ(part_colouring(store, ColourBy::clash).legend.size(), 1U) << "before a job";
    (void)find_clashes(store, {});
    const PartColouring clashes = part_colouring(store, ColourBy::clash);
    EXPECT_EQ(words_of_parts(clashes), (std::vector<std::string>{"hard", "hard", "touch", "none"}));
    expect_colours_of_words(clashes);
}

} // namespace
} // namespace abut::test
