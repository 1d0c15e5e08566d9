// Files that differ from their name, or have no contents, are refused at once, with messages that
// help.

#include <abut/store.h>

#include "tests/io/sample_files.h"
#include "tests/io/support.h"

#include <sys/stat.h>

namespace abut::test {
namespace {

class FileKind : public testing::Test {
protected:
    void refuse(const std::string& path, const std::string& words, ErrorCode code) {
        for (const auto& read :
             {std::function<void()>([&] { (void)read_scene(path); }),
              std::function<void()>([&] { import_models({path}, folder_.path("store.abut")); })}) {
            const std::string text = error_of(path, code, read);
            EXPECT_NE(text.find(words), std::string::npos) << text;
        }
    }
    TemporaryFolder folder_;
    std::map<std::string, std::string> samples_ = sample_files();
};

TEST_F(FileKind, IsNamedIfItDiffersFromTheExtension) {
    const std::vector<std::pair<std::string, std::string>> kinds{
        {"sample.glb", "a GLB file"},  {"little.ply", "a PLY file"},
        {"text.ply", "a PLY file"},    {"sample.off", "an OFF file"},
        {"sample.fbx", "an FBX file"}, {"sample.dae", "an XML file"}};
    std::size_t refused = 0;
    for (const auto& [name, kind] : kinds)
        for (const char* const extension :
             {".stl", ".obj", ".off", ".ply", ".glb", ".dae", ".fbx", ".ifc"})
            if (!name.ends_with(extension)) {
                refuse(folder_.file(std::string("wrong") + extension, samples_.at(name)),
                       "is " + kind + ", though its name ends in " + extension,
                       ErrorCode::malformed);
                ++refused;
            }
    EXPECT_GT(refused, 35U);
    refuse(folder_.file("a.obj", "PK\x03\x04 and more"), "a ZIP archive", ErrorCode::malformed);
    refuse(folder_.file("a.ply", "version https://git-lfs.github.com/spec/v1\noid 1\n"), "Git LFS",
           ErrorCode::malformed);
}

TEST_F(FileKind, ABinaryStlFileMayBeginAsItLikes) {
    for (const char* const start : {"solid", "glTF", "ply\n", "PK\x03\x04", "OFF "}) {
        std::string bytes = samples_.at("binary.stl");
        bytes.replace(0, std::string(start).size(), start);
        EXPECT_EQ(world_triangles(read_scene(folder_.file("a.stl", bytes))).size(), 4U);
    }
}

TEST_F(FileKind, TheSizeOfAnStlFileIsExplained) {
    std::string bytes = samples_.at("binary.stl");
    bytes.resize(bytes.size() - 10);
    refuse(folder_.file("short.stl", bytes), "states 4 triangles in 284 bytes, but it has 274",
           ErrorCode::malformed);
}

/// Files of ten gigabytes that take no space on disk. None may be read to its end.
TEST_F(FileKind, ManyZerosAreNoModel) {
    for (const auto& [name, content] : samples_) {
        const std::string path = folder_.file(name, "");
        std::filesystem::resize_file(path, std::uintmax_t{10} << 30);
        const std::string text = error_of(path, ErrorCode::malformed);
        EXPECT_NE(text.find("zero bytes"), std::string::npos) << text;
    }
    // After a valid beginning, the first zero byte is the error.
    for (const char* const name : {"sample.obj", "sample.off", "text.stl", "text.ply"}) {
        const std::string path = folder_.file(name, samples_.at(name).substr(0, 60));
        std::filesystem::resize_file(path, std::uintmax_t{10} << 30);
        error_of(path, ErrorCode::malformed);
    }
}

TEST_F(FileKind, APipeIsNoFile) {
    for (const char* const extension : {".obj", ".stl", ".glb", ".dae", ".ifc", ".abut"}) {
        const std::string path = folder_.path(std::string("pipe") + extension);
        ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
        EXPECT_FALSE(is_store(path)); // and it does not wait for a writer
        if (std::string(extension) != ".abut")
            refuse(path, "is not a regular file", ErrorCode::unreadable);
    }
}

TEST_F(FileKind, MessagesNameTheFile) {
    const std::string far = folder_.file("far.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n");
    const std::string text = error_of(far, ErrorCode::bad_mesh, [&] { (void)read_mesh(far); });
    EXPECT_NE(text.find("vertex 1 has a coordinate beyond 1e18"), std::string::npos) << text;
}

} // namespace
} // namespace abut::test
