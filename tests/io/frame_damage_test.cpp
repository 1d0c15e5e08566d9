// Frames that must be refused, each with one line that says why, and randomly damaged files.

#include <abut/frame.h>

#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/random.h"

#include <sys/stat.h>

namespace abut::test {
namespace {

class DamagedFrame : public testing::Test {
protected:
    /// In          part: words that the message must contain.
    void refuse(const std::string& name, const std::string& content, ErrorCode code,
                const std::string& part) {
        refuse(folder_.file(name, content), code, part);
    }
    static void refuse(const std::string& path, ErrorCode code, const std::string& part) {
        const std::string text = error_of(path, code, [&] { (void)read_frame(path); });
        EXPECT_NE(text.find(part), std::string::npos) << text;
    }
    [[nodiscard]] std::string sample(const std::string& name, const std::string& what,
                                     const std::string& with) const {
        std::string text = samples_.at(name);
        text.replace(text.find(what), what.size(), with);
        return text;
    }

    TemporaryFolder folder_;
    std::map<std::string, std::string> samples_ = sample_files();
};

TEST_F(DamagedFrame, PathsThatCannotBeRead) {
    refuse(folder_.path("missing.ply"), ErrorCode::file_not_found, "no such file");
    refuse(folder_.path("no/folder.obj"), ErrorCode::file_not_found, "no such file");
    std::filesystem::create_directory(folder_.path("folder.obj"));
    refuse(folder_.path("folder.obj"), ErrorCode::unreadable, "is a folder");
    ASSERT_EQ(mkfifo(folder_.path("pipe.ply").c_str(), 0600), 0);
    refuse(folder_.path("pipe.ply"), ErrorCode::unreadable, "not a regular file");
    refuse("empty.ply", "", ErrorCode::malformed, "is empty");
    refuse("model.stl", "solid", ErrorCode::unsupported, ".obj and .ply");
    refuse("ply", "ply", ErrorCode::unsupported, ".obj and .ply");
}

TEST_F(DamagedFrame, Headers) {
    const auto change = [&](const std::string& what, const std::string& with,
                            const std::string& part) {
        refuse("a.ply", sample("text.ply", what, with), ErrorCode::malformed, part);
    };
    change("ply", "pl", "is not a PLY file");
    change("ascii", "utf-8", "line 2: unknown format utf-8");
    change("format ascii 1.0", "comment", "names no format");
    change("vertex 4", "vertex -4", "line 3: an element lacks its count");
    change("vertex 4", "vertex", "line 3: an element lacks its count");
    change("element vertex 4", "", "line 4: a property before any element");
    change("float z", "half z", "line 6: unknown type half");
    change("float z", "float w", "have no z");
    change("float z", "list uchar float z", "have no z");
    change("end_header", "", "no end");
}

TEST_F(DamagedFrame, FacesThatAreNotRead) {
    refuse("a.ply", sample("text.ply", "uchar int", "uchar float"), ErrorCode::unsupported, "real");
    refuse("a.ply", sample("text.ply", "uchar int", "float int"), ErrorCode::unsupported, "real");
    refuse("a.ply", sample("text.ply", "element face", "element tristrips"), ErrorCode::unsupported,
           "triangle strips");
    refuse("a.ply", sample("text.ply", "vertex_indices", "corners"), ErrorCode::bad_mesh,
           "no triangles");
    refuse("a.ply", sample("text.ply", "3 0 2 1", "-3 0 2 1"), ErrorCode::malformed, "negative");
    refuse("a.obj", samples_.at("sample.obj") + "f 1 2\n", ErrorCode::malformed,
           "line 10: a face needs three corners");
}

TEST_F(DamagedFrame, IndicesOutOfRange) {
    refuse("a.ply", sample("text.ply", "3 0 2 1", "3 0 4 1"), ErrorCode::bad_mesh, "vertex 4 of 4");
    refuse("a.ply", sample("text.ply", "3 0 2 1", "3 0 -1 1"), ErrorCode::bad_mesh,
           "vertex -1 of 4");
    std::string ply = samples_.at("little.ply");
    ply[ply.size() - 2] = 1;
    refuse("a.ply", ply, ErrorCode::bad_mesh, "vertex 65539 of 4");
    for (const char* const number : {"0", "-5", "-9223372036854775808"})
        refuse("a.obj", samples_.at("sample.obj") + "f 1 2 " + number + "\n", ErrorCode::bad_mesh,
               std::string("line 10: a face refers to vertex ") + number);
    // 2^32 + 1 would be 1 if it were cut to 32 bits.
    for (const char* const number : {"5", "4294967297"})
        refuse("a.obj", samples_.at("sample.obj") + "f 1 2 " + number + "\n", ErrorCode::bad_mesh,
               std::string("line 10: a face refers to vertex ") + number + " of 4");
}

TEST_F(DamagedFrame, InvalidNumbers) {
    for (const char* const word : {"1.25x", "x", "0x1", "1,25", "--1", "1..2"}) {
        refuse("a.ply", sample("text.ply", "1.25", word), ErrorCode::malformed, word);
        refuse("a.obj", sample("sample.obj", "1.25", word), ErrorCode::malformed,
               "line 3: a vertex needs three numbers");
    }
    refuse("a.obj", "v 1 2\n", ErrorCode::malformed, "line 1: a vertex needs three numbers");
    for (const char* const word : {"1.0", "x", "99999999999999999999"}) {
        refuse("a.ply", sample("text.ply", "3 0 2 1", std::string("3 0 ") + word + " 1"),
               ErrorCode::malformed, word);
        refuse("a.obj", samples_.at("sample.obj") + "f 1 2 " + word + "\n", ErrorCode::malformed,
               std::string("corner ") + word);
    }
}

TEST_F(DamagedFrame, CoordinatesThatCannotBeUsed) {
    for (const char* const word : {"nan", "-inf", "1e19", "-1e99", "1e999"}) {
        refuse("a.ply", sample("text.ply", "1.25", word), ErrorCode::bad_mesh, "vertex 1 has");
        refuse("a.obj", sample("sample.obj", "1.25", word), ErrorCode::bad_mesh, "vertex 1 has");
    }
}

TEST_F(DamagedFrame, NoTriangles) {
    refuse("a.obj", "v 0 0 0\n", ErrorCode::bad_mesh, "no triangles");
    refuse("a.obj", "\n", ErrorCode::bad_mesh, "no triangles");
    refuse("a.ply", "ply\nformat ascii 1.0\nend_header\n", ErrorCode::bad_mesh, "no triangles");
    refuse(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0\n",
        ErrorCode::bad_mesh, "no triangles");
}

TEST_F(DamagedFrame, CountsThatTheFileCannotHold) {
    for (const char* const name : {"text.ply", "little.ply", "big.ply"}) {
        refuse("a.ply", sample(name, "face 4", "face 5"), ErrorCode::malformed,
               "4 of 5 elements face");
        for (const std::string element : {"vertex", "face"})
            refuse("a.ply", sample(name, element + " 4", element + " 18446744073709551615"),
                   ErrorCode::malformed, "truncated");
    }
    // A list with a length of more than four billion.
    std::string ply = sample("big.ply", "uchar int", "uint int");
    ply.insert(ply.find("end_header\n") + 11 + 48, "\xff\xff\xff");
    refuse("a.ply", ply, ErrorCode::bad_mesh, "vertex"); // what follows is taken for its corners
    ply = sample("big.ply", "uchar int vertex_indices",
                 "uchar int vertex_indices\nproperty list uint uchar other");
    refuse("a.ply", ply, ErrorCode::malformed, "0 of 4 elements face");
    // An element without properties takes no bytes, whatever its count.
    EXPECT_EQ(read_frame(folder_.file("a.ply", sample("text.ply", "element face",
                                                      "element none 18446744073709551615\n"
                                                      "element face")))
                  .triangles.size(),
              4U);
}

TEST_F(DamagedFrame, DataAfterTheLastElement) {
    for (const char* const name : {"text.ply", "little.ply", "big.ply"})
        refuse("a.ply", samples_.at(name) + "0", ErrorCode::malformed, "goes on");
    EXPECT_EQ(
        read_frame(folder_.file("a.ply", samples_.at("text.ply") + " \r\n\n")).triangles.size(),
        4U);
    // A coordinate type of another size than the data.
    refuse("a.ply", sample("little.ply", "float z", "short z"), ErrorCode::malformed, "");
}

TEST_F(DamagedFrame, CutAtEveryByte) {
    const std::string doubles = folder_.path("double.ply");
    write_frame({{{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, doubles);
    samples_["double.ply"] = read_bytes(doubles);
    for (const char* const name : {"text.ply", "little.ply", "big.ply", "double.ply"}) {
        const std::string& content = samples_.at(name);
        // The last line end of a text file may be missing.
        const std::size_t end = content.size() - (std::string(name) == "text.ply" ? 1 : 0);
        for (std::size_t size = 0; size < end; ++size) {
            SCOPED_TRACE(std::string(name) + " cut to " + std::to_string(size));
            refuse("a.ply", content.substr(0, size), ErrorCode::malformed, "");
        }
    }
}

TEST_F(DamagedFrame, RandomBytesAreReadOrRefused) {
    Random random(4713);
    int read = 0, refused = 0;
    for (const char* const name : {"text.ply", "little.ply", "big.ply", "sample.obj"}) {
        const std::string path = folder_.path(name);
        for (int round = 0; round < 3000; ++round) {
            std::string damaged = samples_.at(name);
            for (int i = random.integer(1, 2); i > 0; --i)
                damaged[random.bits() % damaged.size()] = static_cast<char>(random.bits());
            (void)folder_.file(name, damaged);
            try {
                const Mesh mesh = read_frame(path);
                EXPECT_FALSE(mesh.triangles.empty());
                for (const auto& triangle : mesh.triangles)
                    for (const std::uint32_t corner : triangle)
                        EXPECT_LT(corner, mesh.positions.size());
                for (const Vec3& p : mesh.positions)
                    EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
                ++read;
            } catch (const Error& error) {
                EXPECT_EQ(error.file(), path);
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
                ++refused;
            }
        }
    }
    std::cout << read << " read, " << refused << " refused\n";
    EXPECT_GT(read, (read + refused) / 12);
    EXPECT_GT(refused, (read + refused) / 12);
}

} // namespace
} // namespace abut::test
