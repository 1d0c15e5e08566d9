/// Real buildings: the store gives back what read_scene gives, and every file is streamed.
#include <abut/scene.h>
#include <abut/store.h>

#include "tests/support/folder.h"
#include "tests/support/paths.h"
#include "tests/support/store/stores.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(StoreOfData, EqualsReadScene) {
    const std::filesystem::path data = std::filesystem::path(ABUT_SHARED_DATA) / "bim";
    if (!std::filesystem::exists(data))
        GTEST_SKIP() << data << " is not there";
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(data))
        if (entry.path().extension() == ".glb")
            files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    ASSERT_FALSE(files.empty());
    const Folder folder;
    const std::string store = folder / "s.abut";
    const ImportReport report = import_models(files, store, {.memory = std::uint64_t{64} << 20});
    for (std::size_t i = 0; i < files.size(); ++i) {
        SCOPED_TRACE(files[i]);
        EXPECT_TRUE(report.models.at(i).streamed);
        expect_stored(store, read_scene(files[i]), i);
    }
    verify(open_store(store));
}

} // namespace
} // namespace abut::test
