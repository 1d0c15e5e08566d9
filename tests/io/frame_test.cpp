// Frames give vertices and triangles as stored in the file, from every layout of the formats.

#include <abut/frame.h>

#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/random.h"

#include <algorithm>
#include <fmt/format.h>

namespace abut::test {
namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

class Frames : public testing::Test {
protected:
    [[nodiscard]] Mesh read(const std::string& name, const std::string& content) const {
        return read_frame(folder_.file(name, content));
    }
    /// A text PLY file with these vertex and face lines.
    static std::string text_ply(std::size_t vertices, const std::string& vertex_lines,
                                std::size_t faces, const std::string& face_lines,
                                const std::string& real = "double") {
        return fmt::format("ply\nformat ascii 1.0\nelement vertex {0}\nproperty {1} x\n"
                           "property {1} y\nproperty {1} z\nelement face {2}\n"
                           "property list uchar int vertex_indices\nend_header\n{3}{4}",
                           vertices, real, faces, vertex_lines, face_lines);
    }

    TemporaryFolder folder_;
};

TEST_F(Frames, TheTetrahedronInEveryFormat) {
    const auto samples = sample_files();
    for (const char* const name : {"text.ply", "little.ply", "big.ply", "sample.obj"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = read(name, samples.at(name));
        ASSERT_EQ(mesh.positions.size(), kCorners.size());
        for (std::size_t i = 0; i < kCorners.size(); ++i) {
            const auto [x, y, z] = kCorners[i];
            // OBJ does not specify floats, so 0.1 is read as a double.
            const double stored_z = std::string(name) == "sample.obj" && z == 0.1F ? 0.1 : z;
            EXPECT_EQ(mesh.positions[i], (Vec3{x, y, stored_z})) << i;
        }
        EXPECT_EQ(mesh.triangles, Faces(kFaces.begin(), kFaces.end()));
    }
}

TEST_F(Frames, OnlyPositionsIfTheTrianglesAreTheSame) {
    const auto samples = sample_files();
    for (const char* const name : {"text.ply", "little.ply", "big.ply", "sample.obj"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = read(name, samples.at(name));
        const std::string path = folder_.path(name);
        EXPECT_EQ(read_frame_positions(path, mesh.positions.size(), mesh.triangles),
                  mesh.positions);
        EXPECT_FALSE(read_frame_positions(path, mesh.positions.size() + 1, mesh.triangles));
        Faces others = mesh.triangles;
        std::swap(others[1][0], others[1][1]);
        EXPECT_FALSE(read_frame_positions(path, mesh.positions.size(), others));
        others = mesh.triangles;
        others.pop_back();
        EXPECT_FALSE(read_frame_positions(path, mesh.positions.size(), others));
        others = mesh.triangles;
        others.push_back(others.front());
        EXPECT_FALSE(read_frame_positions(path, mesh.positions.size(), others));
    }
    const Mesh mesh = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string bad = folder_.file("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1e30 0\nf 1 2 3\n");
    error_of(bad, ErrorCode::bad_mesh, [&] { (void)read_frame_positions(bad, 3, mesh.triangles); });
}

TEST_F(Frames, VerticesAreNeitherJoinedNorLeftOut) {
    // Vertex 1 repeats 0, 3 is unused, and 5 repeats 4 with another sign of zero.
    const std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 0}, {1, 0, 0},
                                      {9, 9, 9}, {0, 1, 0}, {0, 1, -0.0}};
    const std::string lines = "0 0 0\n0 0 0\n1 0 0\n9 9 9\n0 1 0\n0 1 -0\n";
    const Faces triangles{{0, 2, 4}, {5, 2, 1}, {1, 1, 1}};
    for (const Mesh& mesh : {read("a.ply", text_ply(6, lines, 3, "3 0 2 4\n3 5 2 1\n3 1 1 1\n")),
                             read("a.obj", "v 0 0 0\nv 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0\nv 0 1 -0\n"
                                           "f 1 3 5\nf 6 3 2\nf 2 2 2\n")}) {
        EXPECT_EQ(mesh.positions, positions);
        EXPECT_TRUE(std::signbit(mesh.positions.at(5).z));
        EXPECT_EQ(mesh.triangles, triangles);
    }
}

TEST_F(Frames, PolygonsAreFansWhateverTheirShape) {
    // A quad whose second corner is dented past the diagonal, and the same quad flat. Ear clipping
    // would cut the two differently.
    for (const char* const second : {"0.2 0.2 0", "2 0 0"}) {
        const std::string lines = std::string("0 0 0\n") + second + "\n2 2 0\n0 2 0\n-1 1 0\n";
        const Mesh mesh =
            read("a.ply", text_ply(5, lines, 5, "5 0 1 2 3 4\n0\n1 0\n2 0 1\n4 3 0 1 2\n"));
        EXPECT_EQ(mesh.triangles, (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {3, 0, 1}, {3, 1, 2}}));
    }
    EXPECT_EQ(read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4 1\n").triangles,
              (Faces{{1, 2, 3}, {1, 3, 0}}));
}

TEST_F(Frames, NumbersOfTextAreRoundedToTheirType) {
    const std::string lines = "0.1 +2.5e-1 1e-50\n1 0 0\n0 1 0\n";
    const Mesh doubles = read("a.ply", text_ply(3, lines, 1, "3 0 1 2\n"));
    EXPECT_EQ(doubles.positions.at(0), (Vec3{0.1, 0.25, 1e-50}));
    const Mesh floats = read("a.ply", text_ply(3, lines, 1, "3 0 1 2\n", "float32"));
    EXPECT_EQ(floats.positions.at(0), (Vec3{0.1F, 0.25, 0}));
}

TEST_F(Frames, EveryFormOfObj) {
    const std::string text = "# comment\r\nmtllib a.mtl\r\no part\r\nv 0 0 0 1\r\n"
                             "v 1 0 0 0.5 0.5 0.5\r\n\tv  0   1 0 # comment\r\n"
                             "vt 0 0\r\nvn 0 0 1\r\nvp 1\r\ng group\r\ns off\r\nusemtl m\r\n"
                             "f 1 2 3\r\nf 1/1 2/1 3/1\r\nf 1//1 2//1 3//1\r\n"
                             "f 1/1/1 -2/-1/-1 -1/-1/-1 # comment\r\nf 1 2 \\\r\n4\r\n"
                             "l 1 2\r\np 1\r\nv 1 1 1\r\nf -1 -2 -3";
    const Mesh mesh = read("a.OBJ", text);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}));
    EXPECT_EQ(mesh.triangles,
              (Faces{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 3}, {3, 2, 1}}));
}

/// Writes the data of a PLY file in one of its encodings.
class PlyData {
public:
    explicit PlyData(std::string encoding) : encoding_(std::move(encoding)) {}

    template <typename Value>
    void add(Value value) {
        if (encoding_ == "ascii") {
            bytes_ += fmt::format("{} ", value);
            return;
        }
        std::string word;
        append(word, value);
        if (encoding_ == "binary_big_endian")
            std::reverse(word.begin(), word.end());
        bytes_ += word;
    }
    /// Adds a value of this PLY type.
    void add(const std::string& type, double value) {
        if (type == "char" || type == "int8")
            add(static_cast<std::int8_t>(value));
        else if (type == "uchar" || type == "uint8")
            add(static_cast<std::uint8_t>(value));
        else if (type == "short" || type == "int16")
            add(static_cast<std::int16_t>(value));
        else if (type == "ushort" || type == "uint16")
            add(static_cast<std::uint16_t>(value));
        else if (type == "int" || type == "int32")
            add(static_cast<std::int32_t>(value));
        else if (type == "uint" || type == "uint32")
            add(static_cast<std::uint32_t>(value));
        else if (type == "float" || type == "float32")
            add(static_cast<float>(value));
        else
            add(value);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string encoding_;
    std::string bytes_;
};

const std::vector<std::string> kIntegers{"char",   "int8",   "uchar", "uint8", "short", "int16",
                                         "ushort", "uint16", "int",   "int32", "uint",  "uint32"};
const std::vector<std::string> kReals{"float", "float32", "double", "float64"};

/// Writes a mesh as PLY with a random layout, and with other properties and elements that readers
/// skip.
class RandomPly {
public:
    RandomPly(Random& random, const Mesh& mesh) : random_(random), mesh_(mesh) {}

    std::string write() {
        const std::string encoding = pick({"ascii", "binary_little_endian", "binary_big_endian"});
        PlyData data(encoding);
        std::string header =
            "ply\ncomment element vertex 7\nformat " + encoding + " 1.0\nobj_info none\n";
        std::vector<std::string> elements{"vertex", "face", "material", "edge"};
        std::shuffle(elements.begin(), elements.end(), engine_);
        for (const std::string& element : elements) {
            const std::size_t count = element == "vertex" ? mesh_.positions.size()
                                      : element == "face" ? mesh_.triangles.size()
                                                          : random_.integer(0, 3);
            const auto properties = layout(element);
            header += fmt::format("element {} {}\n", element, count);
            for (const auto& [name, length, type] : properties)
                header += length.empty()
                              ? fmt::format("property {} {}\n", type, name)
                              : fmt::format("property list {} {} {}\n", length, type, name);
            for (std::size_t i = 0; i < count; ++i)
                for (const Property& property : properties)
                    add(data, element, property, i);
        }
        return header + "end_header\n" + data.bytes();
    }

private:
    struct Property {
        std::string name;
        std::string length; ///< the type of a list's length; empty if it is no list
        std::string type;
    };

    std::string pick(const std::vector<std::string>& choices) {
        return choices[random_.bits() % choices.size()];
    }

    std::vector<Property> layout(const std::string& element) {
        std::vector<Property> properties;
        for (int i = random_.integer(0, 3); i > 0; --i)
            properties.push_back({"other", random_.chance(0.4) ? pick(kIntegers) : "",
                                  pick(random_.chance(0.5) ? kIntegers : kReals)});
        if (element == "vertex")
            for (const char* const axis : {"x", "y", "z"})
                properties.push_back({axis, "", pick(kReals)});
        if (element == "face")
            properties.push_back(
                {pick({"vertex_indices", "vertex_index"}), pick(kIntegers), pick(kIntegers)});
        std::shuffle(properties.begin(), properties.end(), engine_);
        return properties;
    }

    void add(PlyData& data, const std::string& element, const Property& property, std::size_t i) {
        if (property.name == "other") {
            const int count = property.length.empty() ? 1 : random_.integer(0, 4);
            if (!property.length.empty())
                data.add(property.length, count);
            for (int k = 0; k < count; ++k)
                data.add(property.type, random_.integer(0, 100));
        } else if (element == "vertex") {
            const Vec3& p = mesh_.positions[i];
            data.add(property.type, property.name == "x" ? p.x : property.name == "y" ? p.y : p.z);
        } else {
            data.add(property.length, 3);
            for (const std::uint32_t corner : mesh_.triangles[i])
                data.add(property.type, corner);
        }
    }

    Random& random_;
    const Mesh& mesh_;
    std::mt19937_64 engine_{random_.bits()};
};

/// Coordinates are multiples of 2^-10, so that they are floats.
Mesh random_mesh(Random& random) {
    Mesh mesh;
    mesh.positions.resize(random.integer(3, 12));
    const auto coordinate = [&] { return 0x1p-10 * random.integer(-100'000, 100'000); };
    for (Vec3& p : mesh.positions) {
        p.x = coordinate();
        p.y = coordinate();
        p.z = coordinate();
    }
    mesh.triangles.resize(random.integer(1, 20));
    const int last = static_cast<int>(mesh.positions.size()) - 1;
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            corner = random.integer(0, last);
    return mesh;
}

TEST_F(Frames, EveryLayoutOfPly) {
    Random random(4711);
    for (int round = 0; round < 500; ++round) {
        const Mesh mesh = random_mesh(random);
        const std::string content = RandomPly(random, mesh).write();
        SCOPED_TRACE(content.substr(0, content.find("end_header")));
        const Mesh same = read("a.ply", content);
        ASSERT_EQ(same.positions, mesh.positions);
        ASSERT_EQ(same.triangles, mesh.triangles);
    }
}

TEST_F(Frames, WritingAndReadingGivesTheSameFrame) {
    Random random(4712);
    for (int round = 0; round < 100; ++round) {
        Mesh mesh = random_mesh(random);
        const bool floats = random.chance(0.5);
        // One coordinate that is no float makes the file use doubles.
        if (!floats) {
            Vec3& p = mesh.positions.back();
            *std::array{&p.x, &p.y, &p.z}.at(round % 3) = 0.1;
        }
        mesh.positions.front().x = -0.0;
        const std::string path = folder_.path("a.ply");
        write_frame(mesh, path);
        const std::string content = read_bytes(path);
        EXPECT_NE(content.find(floats ? "property float y" : "property double y"),
                  std::string::npos);
        const Mesh same = read_frame(path);
        EXPECT_EQ(same.positions, mesh.positions);
        EXPECT_TRUE(std::signbit(same.positions.front().x));
        EXPECT_EQ(same.triangles, mesh.triangles);
    }
}

TEST_F(Frames, TheBytesOfAWrittenFrame) {
    const std::string path = folder_.path("a.PLY");
    write_frame({{{0, 0, 0}, {1, 0, 0}, {0, 2, -0.5}}, {{0, 1, 2}}}, path);
    std::string expected =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar uint vertex_indices\nend_header\n";
    append(expected, std::array<float, 9>{0, 0, 0, 1, 0, 0, 0, 2, -0.5});
    expected += '\3';
    append(expected, std::array<std::uint32_t, 3>{0, 1, 2});
    EXPECT_EQ(read_bytes(path), expected);
}

TEST_F(Frames, UnreadableMeshesAreNotWritten) {
    const Mesh good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const auto refuse = [&](const Mesh& mesh, const std::string& name, ErrorCode code) {
        const std::string path = folder_.path(name);
        error_of(path, code, [&] { write_frame(mesh, path); });
        EXPECT_FALSE(std::filesystem::exists(path));
    };
    refuse(good, "a.obj", ErrorCode::unsupported);
    refuse(good, "no/folder/a.ply", ErrorCode::cannot_write);
    refuse({}, "a.ply", ErrorCode::bad_mesh);
    refuse({good.positions, {}}, "a.ply", ErrorCode::bad_mesh);
    refuse({good.positions, {{0, 1, 3}}}, "a.ply", ErrorCode::bad_mesh);
    for (const double number : {std::nan(""), 1e19}) {
        Mesh mesh = good;
        mesh.positions[1].z = number;
        refuse(mesh, "a.ply", ErrorCode::bad_mesh);
    }
}

} // namespace
} // namespace abut::test
