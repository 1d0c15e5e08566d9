/// Pictures by the command: sizes, aims, bad input. What they show is tested in tests/unit/render.
#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <array>
#include <gtest/gtest.h>
#include <set>

namespace abut::test {
namespace {

/// Width and height in a PNG file; zeros if it is none.
std::array<unsigned, 2> png_size(const std::string& path) {
    const std::string file = read_file(path);
    if (file.size() < 24 || file.compare(1, 3, "PNG") != 0)
        return {};
    const auto number = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value * 256 + static_cast<unsigned char>(file[at + i]);
        return value;
    };
    return {number(16), number(20)};
}

class PictureCommand : public ::testing::Test {
protected:
    void SetUp() override {
        write_glb(one_of_each_kind(), model_);
        const Outcome outcome = draw({"--size", "64x40"});
        if (outcome.err.find("no picture can be drawn here") != std::string::npos)
            GTEST_SKIP() << outcome.err;
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    Outcome draw(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"picture", model_, "--out", out_, "--json"});
        return run_abut(arguments);
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "model.glb", out_ = folder_ / "a.png";
};

TEST_F(PictureCommand, HasTheSizeThatIsAskedFor) {
    EXPECT_EQ(draw({}).status, 0);
    EXPECT_EQ(png_size(out_), (std::array<unsigned, 2>{1600, 1000}));
    const Outcome outcome = draw({"--size", "321x123", "--view", "top"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(png_size(out_), (std::array<unsigned, 2>{321, 123}));
    EXPECT_EQ(outcome.json()["width"], 321);
    EXPECT_EQ(outcome.json()["picture"], out_);
}

TEST_F(PictureCommand, IsTheSameInEveryRunAndOfAStore) {
    const std::vector<std::string> small{"--size", "200x120"};
    EXPECT_EQ(draw(small).status, 0);
    const std::string first = read_file(out_);
    EXPECT_EQ(draw(small).status, 0);
    EXPECT_EQ(read_file(out_), first);
    const std::string store = folder_ / "site.abut";
    ASSERT_EQ(run_abut({"import", model_, store, "--quiet"}).status, 0);
    const Outcome outcome =
        run_abut({"picture", store, "--out", out_, "--size", "200x120", "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(read_file(out_), first);
}

TEST_F(PictureCommand, ShowsEachKindOfClash) {
    const Outcome found = run_abut({"clash", model_, "--clearance", "0.5", "--json"});
    const auto clashes = found.json()["clashes"];
    ASSERT_GE(clashes.size(), 4U);
    for (const auto& clash : clashes) {
        const Outcome outcome =
            draw({"--clash", clash["id"], "--clearance", "0.5", "--size", "160x100"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
    EXPECT_EQ(draw({"--eye", "9,9,9", "--look", "0,0,0", "--size", "160x100", "--plain"}).status,
              0);
    EXPECT_EQ(draw({"--eye", "0,9,0", "--look", "0,0,0", "--size", "160x100"}).status, 0);
}

TEST_F(PictureCommand, ColoursByWhatModelsState) {
    Scene scene = one_of_each_kind();
    PropertiesBuilder properties;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        properties.add("storey", "Level " + std::to_string(i));
        properties.next_part();
    }
    scene.properties = properties.finish(scene.parts.size());
    write_glb(scene, model_);
    const std::string store = folder_ / "site.abut";
    ASSERT_EQ(run_abut({"import", model_, store, "--quiet"}).status, 0);
    std::set<std::string> pictures;
    for (const std::string by : {"material", "storey", "type", "file", "part"}) {
        const Outcome outcome = draw({"--color-by", by, "--size", "160x100"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const std::string of_models = read_file(out_);
        pictures.insert(of_models);
        EXPECT_EQ(run_abut({"picture", store, "--color-by", by, "--size", "160x100", "--out", out_,
                            "--quiet"})
                      .status,
                  0);
        EXPECT_EQ(read_file(out_), of_models) << by;
    }
    EXPECT_GE(pictures.size(), 3U); // materials may be as types, and one file as one type
}

TEST_F(PictureCommand, RefusesBadInput) {
    expect_refused(draw({"--size", "0x5"}), {"--size", "WIDTHxHEIGHT"});
    expect_refused(draw({"--size", "100"}), {"--size"});
    expect_refused(draw({"--size", "9999x9999"}), {"--size"});
    expect_refused(draw({"--view", "behind"}), {"--view"});
    expect_refused(draw({"--eye", "1,2,3"}), {"--look"});
    expect_refused(draw({"--eye", "1,2,3", "--look", "1,2,3"}), {"--look", "same"});
    expect_refused(draw({"--part", "nobody"}), {"nobody"});
    expect_refused(draw({"--clash", "12"}), {"--clash", "hexadecimal"});
    expect_refused(draw({"--clash", "0123456789abcdef"}), {"no clash"});
    expect_refused(draw({"--section-box", "1,2,3"}), {"--section-box"});
    expect_refused(draw({"--part", "a", "--view", "top"}), {"--view"});
    expect_refused(draw({"--color-by", "clash"}), {"clash", "store"});
    expect_refused(run_abut({"picture", model_, "--out", folder_ / "a.jpg"}), {"FILE.png"});
    expect_refused(run_abut({"picture", folder_ / "none.glb", "--out", out_}), {"none.glb"});
}

} // namespace
} // namespace abut::test
