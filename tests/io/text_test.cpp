// Text files as other programs write them: with byte-order marks, line ends of all systems, and
// invalid numbers. Faulty lines are refused by their number.

#include <abut/elementary_impact.h>
#include <abut/frame.h>

#include "tests/io/sample_files.h"
#include "tests/io/support.h"

namespace abut::test {
namespace {

const std::string kMark = "\xef\xbb\xbf";

std::string replaced_all(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos;
         at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

std::string utf_16(const std::string& text) {
    std::string bytes = "\xff\xfe";
    for (const char c : text)
        bytes += {c, '\0'};
    return bytes;
}

class Text : public testing::Test {
protected:
    void expect_read(const std::string& name, const std::string& content) {
        const Scene expected = read_scene(folder_.file("plain-" + name, samples_.at(name)));
        const Scene scene = read_scene(folder_.file(name, content));
        EXPECT_EQ(world_triangles(scene), world_triangles(expected)) << name;
        EXPECT_EQ(scene.parts.at(0).id, expected.parts.at(0).id) << name;
    }
    void refuse(const std::string& name, const std::string& content, const std::string& words) {
        const std::string text = error_of(folder_.file(name, content), ErrorCode::malformed);
        EXPECT_NE(text.find(words), std::string::npos) << text;
    }
    TemporaryFolder folder_;
    std::map<std::string, std::string> samples_ = sample_files();
    const std::vector<std::string> texts_{"sample.obj", "sample.off", "text.stl", "text.ply"};
};

TEST_F(Text, AByteOrderMarkIsSkipped) {
    for (const std::string& name : texts_)
        expect_read(name, kMark + samples_.at(name));
    expect_read("little.ply", kMark + samples_.at("little.ply"));
    // The mark must not hide the first line, or all indices would shift by one.
    const Mesh mesh = read_mesh(
        folder_.file("first.obj", kMark + "v 5 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"));
    EXPECT_EQ(mesh.positions.at(0), (Vec3{5, 0, 0}));
}

TEST_F(Text, LinesEndAsOnAnySystem) {
    for (const std::string& name : texts_)
        for (const char* const end : {"\r\n", "\r"})
            expect_read(name, replaced_all(samples_.at(name), "\n", end));
    // Files joined from files of several systems.
    const std::string obj = samples_.at("sample.obj");
    const std::size_t middle = obj.find("\nf ") + 1;
    for (const char* const first : {"\n", "\r\n", "\r"})
        for (const char* const second : {"\n", "\r\n", "\r"})
            expect_read("sample.obj", replaced_all(obj.substr(0, middle), "\n", first) +
                                          replaced_all(obj.substr(middle), "\n", second));
}

TEST_F(Text, BlanksOfAllKindsSeparateWords) {
    for (const std::string& name : {std::string("sample.off"), std::string("text.ply")}) {
        const std::size_t body = samples_.at(name).find("0 0 0");
        for (const char* const blank : {"\t", "  ", "\f", " \v "})
            expect_read(name, samples_.at(name).substr(0, body) +
                                  replaced_all(samples_.at(name).substr(body), " ", blank));
    }
    expect_read("sample.obj", replaced_all(samples_.at("sample.obj"), " ", "\f\t"));
}

TEST_F(Text, KeywordsOfStlMayBeInCapitals) {
    std::string text = samples_.at("text.stl");
    for (const auto& [word, capitals] : std::vector<std::pair<std::string, std::string>>{
             {"solid", "SOLID"}, {"facet", "FACET"}, {"loop", "LOOP"}, {"vertex", "Vertex"}})
        text = replaced_all(text, word, capitals);
    expect_read("text.stl", text);
}

TEST_F(Text, ABackslashContinuesALineOfAnObjFileButNoComment) {
    expect_read("sample.obj", replaced_all(samples_.at("sample.obj"), "1.25 0", "1.25 \\\n 0"));
    expect_read("sample.obj", replaced_all(samples_.at("sample.obj"), "1.25 0", "1.25 \\\r\n 0"));
    expect_read("sample.obj", "# made from C:\\models\\\n" + samples_.at("sample.obj"));
    expect_read("sample.obj", samples_.at("sample.obj") + "# end \\");
}

TEST_F(Text, OtherEncodingsAreRefused) {
    for (const std::string& name : texts_) {
        refuse(name, utf_16(samples_.at(name)), "UTF-16");
        std::string bytes = samples_.at(name);
        // Zero bytes at the end, as after a crash of the machine that wrote the file.
        std::fill(bytes.end() - 20, bytes.end(), '\0');
        error_of(folder_.file(name, bytes), ErrorCode::malformed);
    }
    refuse("sample.obj", utf_16(samples_.at("sample.obj")).substr(2), "zero bytes");
}

TEST_F(Text, InvalidNumbersAreRefusedWithTheirLine) {
    for (const char* const word :
         {"1,25", "1.25D0", "1.25d+0", "1.2.5", "0x1", "1.25f", "1e", "--1"}) {
        refuse("sample.obj", replaced_all(samples_.at("sample.obj"), "1.25", word), "line 3");
        refuse("sample.off", replaced_all(samples_.at("sample.off"), "1.25", word), "line 4");
        refuse("text.stl", replaced_all(samples_.at("text.stl"), "1.25", word), "line ");
        refuse("text.ply", replaced_all(samples_.at("text.ply"), "1.25", word), word);
    }
    for (const char* const word :
         {"+1.25", "1.25e0", "12.5E-1", "01.25", "1.250000000000000000000"})
        for (const std::string& name : texts_)
            expect_read(name, replaced_all(samples_.at(name), "1.25", word));
}

TEST_F(Text, FramesAreReadAlike) {
    for (const std::string& name : {std::string("sample.obj"), std::string("text.ply")}) {
        const Mesh expected = read_frame(folder_.file(name, samples_.at(name)));
        for (const std::string& content :
             {kMark + samples_.at(name), replaced_all(samples_.at(name), "\n", "\r")}) {
            const Mesh mesh = read_frame(folder_.file(name, content));
            EXPECT_EQ(mesh.positions, expected.positions);
            EXPECT_EQ(mesh.triangles, expected.triangles);
        }
        EXPECT_THROW((void)read_frame(folder_.file(name, utf_16(samples_.at(name)))), Error);
    }
}

TEST_F(Text, ElementaryQueriesAreReadAlike) {
    std::string rows;
    for (int i = 0; i < 8; ++i)
        rows += std::to_string(i) + ",1,0,1,1,2\n";
    const auto read = [&](const std::string& content) {
        return read_elementary_queries(folder_.file("queries.csv", content),
                                       ElementaryKind::vertex_face);
    };
    const ElementaryQueries expected = read(rows);
    for (const std::string& content :
         {kMark + rows, replaced_all(rows, "\n", "\r\n"), replaced_all(rows, "\n", "\r")}) {
        const ElementaryQueries queries = read(content);
        ASSERT_EQ(queries.pairs.size(), 1U);
        EXPECT_EQ(queries.pairs[0].start, expected.pairs[0].start);
        EXPECT_EQ(queries.pairs[0].end, expected.pairs[0].end);
    }
    EXPECT_THROW((void)read(utf_16(rows)), Error);
}

} // namespace
} // namespace abut::test
