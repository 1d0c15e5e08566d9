// The steel of a building as an archive gives the same model as the file.

#include <abut/error.h>
#include <abut/scene.h>

#include "tests/support/paths.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace abut::test {
namespace {

TEST(IfcZipData, EqualsTheFileInTheArchive) {
    const std::string folder = std::string(ABUT_SHARED_DATA) + "/ifc/schependomlaan/";
    if (!std::filesystem::exists(folder + "ROOT-staal.ifczip"))
        GTEST_SKIP() << "no test data: " << folder;
    Scene plain, archived;
    try {
        plain = read_scene(folder + "IFC-staal.ifc");
        archived = read_scene(folder + "ROOT-staal.ifczip");
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsupported)
            throw;
        GTEST_SKIP() << error.what();
    }
    ASSERT_EQ(archived.parts.size(), plain.parts.size());
    EXPECT_GT(plain.parts.size(), 50U);
    ASSERT_EQ(archived.meshes.size(), plain.meshes.size());
    for (std::size_t i = 0; i < plain.parts.size(); ++i) {
        EXPECT_EQ(archived.parts[i].id, plain.parts[i].id);
        EXPECT_EQ(archived.parts[i].world_from_mesh, plain.parts[i].world_from_mesh);
        EXPECT_EQ(archived.meshes[archived.parts[i].mesh].positions,
                  plain.meshes[plain.parts[i].mesh].positions);
    }
}

} // namespace
} // namespace abut::test
