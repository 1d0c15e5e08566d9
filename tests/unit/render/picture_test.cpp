// Pictures compared with expectations that are computed without OpenGL.
#include <abut/error.h>
#include <abut/picture.h>

#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <png.h>

namespace abut::test {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 100;

Scene scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    scene.file = "made.glb";
    scene.up = UpAxis::z;
    scene.meshes = meshes;
    for (std::uint32_t i = 0; i < meshes.size(); ++i)
        scene.parts.push_back({"part" + std::to_string(i), "Part", "Thing", i, {}, {}});
    return scene;
}

/// Neither edges nor ground nor occlusion: what differs from the background is covered by a part.
PictureOptions plain(const Camera& camera) {
    PictureOptions options;
    options.aim = camera;
    options.width = kWidth;
    options.height = kHeight;
    options.samples = 1;
    options.edges = options.ambient_occlusion = options.ground = false;
    return options;
}

Camera camera_to(const Vec3& eye, const Vec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.forward = {target.x - eye.x, target.y - eye.y, target.z - eye.z};
    camera.width = kWidth;
    camera.height = kHeight;
    return camera;
}

/// Returns whether a ray meets a box: it is inside all three slabs at once.
bool meets(const Ray& ray, const Box3& box) {
    double enter = 0, leave = 1e300;
    const auto slab = [&](double at, double way, double lower, double upper) {
        const double a = (lower - at) / way, b = (upper - at) / way;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    };
    slab(ray.origin.x, ray.direction.x, box.lower.x, box.upper.x);
    slab(ray.origin.y, ray.direction.y, box.lower.y, box.upper.y);
    slab(ray.origin.z, ray.direction.z, box.lower.z, box.upper.z);
    return enter <= leave;
}

Colour pixel(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* at = picture.pixels.data() + (std::size_t{y} * picture.width + x) * 3;
    return {at[0], at[1], at[2]};
}

std::size_t different_pixels(const Picture& a, const Picture& b, int more_than = 0) {
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < a.height; ++y)
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const Colour p = pixel(a, x, y), q = pixel(b, x, y);
            count += std::abs(p.red - q.red) > more_than ||
                             std::abs(p.green - q.green) > more_than ||
                             std::abs(p.blue - q.blue) > more_than
                         ? 1
                         : 0;
        }
    return count;
}

class PictureTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            const OffscreenContext context;
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_F(PictureTest, ShowsABoxWhereRaysMeetIt) {
    Random random(191);
    std::size_t covered = 0, all = 0, wrong = 0;
    for (int round = 0; round < many(25); ++round) {
        const Box3 box{
            {random.uniform(-2, -0.2), random.uniform(-2, -0.2), random.uniform(-2, -0.2)},
            {random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)}};
        const Vec3 eye{random.uniform(3, 9), random.uniform(-7, 7), random.uniform(-6, 6)};
        const Camera camera = camera_to(eye, {0.1, 0.2, 0.3});
        const Picture shown = picture({scene_of({box_mesh(box.lower, box.upper)})}, plain(camera));
        // The same without the box: it lies behind the camera.
        const Picture empty =
            picture({scene_of({box_mesh({eye.x + 50, 0, 0}, {eye.x + 51, 1, 1})})}, plain(camera));
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                const bool is_shown = pixel(shown, x, y) != pixel(empty, x, y);
                // A pixel whose corners disagree with its middle may go either way.
                std::size_t hits = 0;
                for (const double dx : {0.45, 0.5, 0.55})
                    for (const double dy : {0.45, 0.5, 0.55})
                        hits += meets(ray_through(camera, x + dx, y + dy), box) ? 1 : 0;
                ++all;
                covered += hits == 9 ? 1 : 0;
                wrong += (hits == 9 && !is_shown) || (hits == 0 && is_shown) ? 1 : 0;
            }
    }
    std::cout << covered << " of " << all << " pixels covered\n";
    EXPECT_GT(covered, all / 50);
    EXPECT_LT(covered, all / 2);
    EXPECT_EQ(wrong, 0U);
}

TEST_F(PictureTest, OfModelsInMemoryHasTheColoursOfStoreys) {
    Scene scene = scene_of({box_mesh({-3, 0, -1}, {-1, 1, 1}), box_mesh({1, 0, -1}, {3, 1, 1})});
    const PictureOptions options = [] {
        PictureOptions by_storey = plain(camera_to({0, -8, 0}, {0, 0, 0}));
        by_storey.colour_by = ColourBy::storey;
        return by_storey;
    }();
    const Picture without = picture({scene}, options);
    PropertiesBuilder properties;
    for (const char* storey : {"Level 1", "Level 2"}) {
        properties.add("storey", storey);
        properties.next_part();
    }
    scene.properties = properties.finish(2);
    const Picture with = picture({scene}, options);
    const auto is_grey = [](const Colour& c) {
        return std::abs(c.red - c.green) < 12 && std::abs(c.green - c.blue) < 12;
    };
    for (const std::uint32_t x : {50U, 110U}) {
        EXPECT_TRUE(is_grey(pixel(without, x, 50))) << x;
        EXPECT_FALSE(is_grey(pixel(with, x, 50))) << x;
    }
    EXPECT_NE(pixel(with, 50, 50), pixel(with, 110, 50));
    EXPECT_EQ(pixel(without, 50, 50), pixel(without, 110, 50));
}

TEST_F(PictureTest, IsTheSameInEveryRun) {
    PictureOptions options;
    options.width = 320, options.height = 200;
    const std::vector<Scene> models{
        scene_of({box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({2, 0, 0}, {3, 2, 1})})};
    EXPECT_EQ(picture(models, options), picture(models, options));
    options.aim = PartAim{"part1"};
    EXPECT_EQ(picture(models, options), picture(models, options));
}

TEST_F(PictureTest, OfSharedMeshesIsThatOfCopies) {
    Scene shared = scene_of({box_mesh({0, 0, 0}, {1, 1, 1})}), copies = shared;
    Transform mirrored;
    mirrored.m = {-1, 0, 0, 0, 0.5, 0.2, 0, 0, 1.5, 3.25, 0.5, 0.25};
    shared.parts.push_back({"part1", "Part", "Thing", 0, mirrored, {}});
    copies.meshes.push_back(copies.meshes.front());
    copies.parts.push_back({"part1", "Part", "Thing", 1, mirrored, {}});
    PictureOptions options;
    options.width = 320, options.height = 200;
    const Picture a = picture({shared}, options), b = picture({copies}, options);
    EXPECT_LT(different_pixels(a, b, 8), 320U * 200 / 500);
}

TEST_F(PictureTest, OfASectionBoxLacksWhatLiesOutside) {
    const Camera camera = camera_to({0.02, -6, 0.03}, {0, 0, 0});
    PictureOptions options = plain(camera);
    const std::vector<Scene> models{scene_of({box_mesh({-2, -1, -2}, {2, 1, 2})})};
    options.section_box = Box3{{0, -5, -5}, {5, 5, 5}};
    const Picture cut = picture(models, options);
    options.section_box.reset();
    const Picture whole = picture(models, options);
    // The right half is as it was; of the left, what is left shows the inside, in one flat colour.
    for (std::uint32_t y = 45; y < 55; ++y) {
        EXPECT_EQ(pixel(cut, 100, y), pixel(whole, 100, y));
        EXPECT_NE(pixel(cut, 60, y), pixel(whole, 60, y));
    }
    options.sections = {{{1, 0, 0}, -3}};
    const Picture nothing = picture(models, options);
    EXPECT_NE(pixel(nothing, 80, 50), pixel(whole, 80, 50));
}

TEST_F(PictureTest, OfAPairShowsBothParts) {
    const auto reds = [](const Picture& shown) {
        std::array<std::size_t, 2> count{};
        for (std::uint32_t y = 0; y < shown.height; ++y)
            for (std::uint32_t x = 0; x < shown.width; ++x) {
                const Colour p = pixel(shown, x, y);
                count[0] += p.red > p.blue + 60 ? 1 : 0;
                count[1] += p.blue > p.red + 60 ? 1 : 0;
            }
        return count;
    };
    PictureOptions options;
    options.width = 320, options.height = 200;
    Scene scene =
        scene_of({box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({0.9, 0.2, 0.2}, {2, 0.5, 0.5}),
                  box_mesh({-3, -3, -1}, {3, 3, -0.5})});
    options.aim = PairAim{{"made.glb", "made.glb"}, {"part0", "part1"}, {}};
    const auto meeting = reds(picture({scene}, options));
    EXPECT_GT(meeting[0], 1000U);
    EXPECT_GT(meeting[1], 1000U);
    // One inside of the other: seen through a section.
    scene.meshes[1] = box_mesh({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7});
    const auto contained = reds(picture({scene}, options));
    EXPECT_GT(contained[0], 1000U);
    EXPECT_GT(contained[1], 1000U);
    // The section that opens the part has room beside six given ones and a section box, which cut
    // nothing here.
    options.sections.assign(6, SectionPlane{{0, 0, 1}, 50});
    options.section_box = Box3{{-60, -60, -60}, {60, 60, 60}};
    EXPECT_EQ(reds(picture({scene}, options)), contained);
    // They do cut.
    options.section_box = Box3{{-60, -60, -60}, {60, 60, 0.1}};
    EXPECT_EQ(reds(picture({scene}, options))[1], 0U);
}

/// The distance of a point from a solid box.
double box_distance(const Box3& box, const Vec3& p) {
    const auto beyond = [](double at, double low, double high) {
        return std::max({low - at, 0.0, at - high});
    };
    return std::hypot(beyond(p.x, box.lower.x, box.upper.x), beyond(p.y, box.lower.y, box.upper.y),
                      beyond(p.z, box.lower.z, box.upper.z));
}

TEST_F(PictureTest, OfDistancesColoursAWallByItsDistanceFromABox) {
    const Box3 box{{-0.4, -1.5, -0.3}, {0.4, -1, 0.3}};
    const Camera camera = camera_to({2, -6, 1.5}, {0, 0, 0});
    const Scene scene =
        scene_of({box_mesh(box.lower, box.upper), box_mesh({-4, 0, -4}, {4, 1, 4})});
    PictureOptions options = plain(camera);
    const Picture before = picture({scene}, options);
    constexpr double kReach = 1.6;
    options.distances = PartDistances{"part0", kReach};
    const Picture coloured = picture({scene}, options);
    const Colour own = part_colours(std::array{ViewPart{1, "", "part1", "Part", "Thing", {}, {}}},
                                    ColourBy::material)
                           .front();
    std::size_t near = 0, far = 0, wrong = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const Ray ray = ray_through(camera, x + 0.5, y + 0.5);
            if (meets(ray, {{box.lower.x - 0.1, box.lower.y - 0.1, box.lower.z - 0.1},
                            {box.upper.x + 0.1, box.upper.y + 0.1, box.upper.z + 0.1}}))
                continue; // on the box, or at its border
            const double t = -ray.origin.y / ray.direction.y;
            const Vec3 at{ray.origin.x + t * ray.direction.x, 0,
                          ray.origin.z + t * ray.direction.z};
            if (std::abs(at.x) > 3.9 || std::abs(at.z) > 3.9)
                continue;
            const double distance = box_distance(box, at);
            const Colour was = pixel(before, x, y), is = pixel(coloured, x, y);
            if (std::abs(distance - kReach) < 0.03)
                continue; // the border of the colours
            if (distance > kReach) {
                ++far;
                wrong += is == was ? 0 : 1;
                continue;
            }
            ++near;
            // The light is the same with both colours.
            const Colour ramp = distance_colour(distance / kReach);
            const auto differs = [](int lit, int lit_own, int asked, int own_colour) {
                return std::abs(lit - double(lit_own) / own_colour * asked) > 6;
            };
            wrong += differs(is.red, was.red, ramp.red, own.red) ||
                             differs(is.green, was.green, ramp.green, own.green) ||
                             differs(is.blue, was.blue, ramp.blue, own.blue)
                         ? 1
                         : 0;
        }
    std::cout << near << " pixels within the reach, " << far << " beyond\n";
    EXPECT_GT(near, 800U);
    EXPECT_GT(far, 800U);
    EXPECT_LE(wrong, (near + far) / 500);
}

TEST_F(PictureTest, OfDistancesNeedsAPartAndAReach) {
    const Scene scene = scene_of({box_mesh({0, 0, 0}, {1, 1, 1})});
    PictureOptions options = plain(camera_to({3, -6, 1.5}, {0, 0, 0}));
    options.distances = PartDistances{"nobody", 1};
    EXPECT_THROW((void)picture({scene}, options), Error);
    options.distances = PartDistances{"part0", 0};
    EXPECT_THROW((void)picture({scene}, options), Error);
}

TEST_F(PictureTest, IsWrittenAsPng) {
    const Folder folder;
    Picture drawn{3, 2, {}};
    for (int i = 0; i < 18; ++i)
        drawn.pixels.push_back(static_cast<std::uint8_t>(i * 13));
    const std::string path = folder / "a.png";
    write_png(drawn, path);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(image.width, 3U);
    EXPECT_EQ(image.height, 2U);
    EXPECT_EQ(pixels, drawn.pixels);
    EXPECT_THROW(write_png(drawn, folder / "no/such/folder/a.png"), Error);
    EXPECT_THROW(write_png({}, path), Error);
}

TEST_F(PictureTest, OfBadOptionsOrStrangeModels) {
    const std::vector<Scene> models{scene_of({box_mesh({0, 0, 0}, {1, 1, 1})})};
    const auto refused = [&](const std::function<void(PictureOptions&)>& change) {
        PictureOptions options = plain(camera_to({5, 5, 5}, {0, 0, 0}));
        change(options);
        EXPECT_THROW(picture(models, options), Error);
    };
    refused([](PictureOptions& o) { o.width = 0; });
    refused([](PictureOptions& o) { o.height = 100'000; });
    refused([](PictureOptions& o) { o.samples = 3; });
    refused([](PictureOptions& o) { o.aim = PartAim{"nobody"}; });
    refused([](PictureOptions& o) { o.sections.resize(7); });
    refused([](PictureOptions& o) { o.colour_by = ColourBy::clash; });
    refused([](PictureOptions& o) { o.aim = camera_to({std::nan(""), 0, 0}, {1, 1, 1}); });
    PictureOptions small;
    small.width = 40, small.height = 30;
    EXPECT_EQ(picture(std::vector<Scene>{}, small).pixels.size(), 3600U);
    Mesh flat; // one point, three times
    flat.positions = {{1, 1, 1}};
    flat.triangles = {{0, 0, 0}};
    EXPECT_EQ(picture({scene_of({flat})}, small).pixels.size(), 3600U);
    EXPECT_EQ(picture({scene_of({box_mesh({-1e17, -1e17, -1e17}, {1e17, 1e17, 1e17})})}, small)
                  .pixels.size(),
              3600U);
}

} // namespace
} // namespace abut::test
