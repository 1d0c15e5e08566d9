#include "tests/io/ways.h"

#include "io/scene/scene_source.h"
#include "store/import/mesh_draft.h"
#include "tests/support/store/stores.h"

#include <gtest/gtest.h>

namespace abut::test {

Scene read_both_ways(const std::string& path, const std::string& folder) {
    SourceOptions options;
    options.folder = folder;
    options.memory = std::uint64_t{1} << 20;
    const auto source = open_scene_source({path}, options);
    EXPECT_TRUE(source->streams());
    Scene streamed;
    for (std::uint32_t i = 0; i < source->meshes(); ++i)
        streamed.meshes.push_back(load_mesh(*source, i).mesh);
    for (std::uint64_t i = 0; i < source->parts().size(); ++i)
        streamed.parts.push_back(source->parts().part(i));
    Scene scene = read_scene(path);
    expect_same_scene(scene, streamed);
    return scene;
}

} // namespace abut::test
