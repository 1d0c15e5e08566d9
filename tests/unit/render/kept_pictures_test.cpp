// Pictures compared with kept ones: grids of 64 x 40 mean luminances, as text. They show changes of
// the whole picture (light, edges, occlusion, ghosts, sections), which other tests do not compare.
// After a change that is wanted, look at the new pictures and run the test with ABUT_KEEP_PICTURES=1.
#include <abut/error.h>
#include <abut/levels.h>
#include <abut/picture.h>
#include <abut/view.h>

#include "scenes/plant/plant.h"
#include "tests/support/folder.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr std::uint32_t kColumns = 64, kRows = 40, kCell = 10;
constexpr int kTolerance = 2; ///< of 64 levels
constexpr std::size_t kMostOutside = kColumns * kRows / 100;
constexpr const char* kDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-";

using Grid = std::vector<std::string>; ///< a digit for the mean luminance of each cell

Grid grid_of(const Picture& picture) {
    Grid grid(kRows);
    for (std::uint32_t row = 0; row < kRows; ++row)
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            double sum = 0;
            for (std::uint32_t y = 0; y < kCell; ++y)
                for (std::uint32_t x = 0; x < kCell; ++x) {
                    const std::size_t at =
                        3 * (std::size_t{row * kCell + y} * picture.width + column * kCell + x);
                    sum += 0.299 * picture.pixels[at] + 0.587 * picture.pixels[at + 1] +
                           0.114 * picture.pixels[at + 2];
                }
            grid[row] += kDigits[static_cast<int>(sum / (kCell * kCell) / 4)];
        }
    return grid;
}

/// Cells that differ by more than the tolerance.
std::size_t outside(const Grid& a, const Grid& b) {
    const std::string digits = kDigits;
    std::size_t count = 0;
    for (std::size_t row = 0; row < kRows; ++row)
        for (std::size_t column = 0; column < kColumns; ++column) {
            const auto at = [&](const Grid& grid) {
                return static_cast<int>(digits.find(grid.at(row).at(column)));
            };
            count += std::abs(at(a) - at(b)) > kTolerance ? 1 : 0;
        }
    return count;
}

void expect_kept(const Picture& picture, const std::string& name) {
    ASSERT_EQ(picture.width, kColumns * kCell);
    ASSERT_EQ(picture.height, kRows * kCell);
    const std::string path = std::string(ABUT_SOURCE_DIR "/tests/unit/render/kept/") + name;
    const Grid shown = grid_of(picture);
    if (std::getenv("ABUT_KEEP_PICTURES") != nullptr) { // NOLINT: no other thread sets it
        std::ofstream file(path + ".txt");
        for (const std::string& row : shown)
            file << row << '\n';
        write_png(picture, name + ".png");
        return;
    }
    Grid kept;
    std::ifstream file(path + ".txt");
    for (std::string row; std::getline(file, row);)
        kept.push_back(row);
    ASSERT_EQ(kept.size(), kRows) << path;
    EXPECT_LE(outside(shown, kept), kMostOutside) << name;
    // The comparison can fail: half a picture darker is another picture.
    Picture dark = picture;
    for (std::size_t i = 0; i < dark.pixels.size() / 2; ++i)
        dark.pixels[i] = static_cast<std::uint8_t>(dark.pixels[i] / 5 * 4);
    EXPECT_GT(outside(grid_of(dark), kept), 10 * kMostOutside);
}

PictureOptions sized() {
    PictureOptions options;
    options.width = kColumns * kCell;
    options.height = kRows * kCell;
    return options;
}

Scene small_plant() {
    PlantOptions options;
    options.triangles = 30'000;
    options.clashes = 5;
    return make_plant(options).scene;
}

class KeptPictures : public testing::Test {
protected:
    void SetUp() override {
        try {
            const OffscreenContext context;
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_F(KeptPictures, OfAPlant) {
    const Scene plant = small_plant();
    expect_kept(picture({plant}, sized()), "plant");
    PictureOptions plain = sized();
    plain.edges = plain.ambient_occlusion = plain.ground = false;
    expect_kept(picture({plant}, plain), "plant_plain");
}

TEST_F(KeptPictures, OfASection) {
    PictureOptions options = sized();
    options.sections = {{{0, 1, 0}, 6.5}};
    options.aim = NamedView::top;
    expect_kept(picture({small_plant()}, options), "section");
}

TEST_F(KeptPictures, OfAPartAmongGhosts) {
    Scene scene;
    scene.file = "made.glb";
    scene.up = UpAxis::z;
    scene.meshes = {torus_mesh(2, 0.5, 60, 24), box_mesh({-0.4, -3, -0.4}, {0.4, 3, 0.4}),
                    sphere_mesh(1, 24, 16)};
    for (std::uint32_t i = 0; i < 3; ++i)
        scene.parts.push_back({"part" + std::to_string(i), "Part", "Thing", i, {}, {}});
    PictureOptions options = sized();
    options.aim = PartAim{"part1"};
    expect_kept(picture({scene}, options), "ghosts");
}

TEST_F(KeptPictures, OfLevelsWhileTheEyeMoves) {
    const Folder folder;
    write_glb(small_plant(), folder / "a.glb");
    (void)import_models({folder / "a.glb"}, folder / "a.abut");
    (void)build_levels(folder / "a.abut");
    const OffscreenContext context;
    const Store store = open_store(folder / "a.abut");
    View view(store, {.triangle_budget = 20'000, .background = false});
    Renderer renderer(view.parts().size(), view.origin());
    Camera lens;
    lens.width = kColumns * kCell, lens.height = kRows * kCell;
    const Camera camera = look_at_box(view.bounds(), {0.8, -0.5, 0.6}, {0, 1, 0}, lens);
    RenderStyle style;
    style.up = {0, 1, 0};
    style.ambient_occlusion = false;
    const Picture all = renderer.picture(view.frame(camera), camera, style);
    expect_kept(all, "levels");
    // Without backs the picture is nearly the same: some parts penetrate others.
    style.leave_out_backs = true;
    const Picture fronts = renderer.picture(view.frame(camera), camera, style);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < all.pixels.size(); i += 3)
        differ += std::abs(all.pixels[i] - fronts.pixels[i]) > 16 ? 1 : 0;
    std::cout << differ << " pixels differ without backs\n";
    EXPECT_LT(differ, all.pixels.size() / 3 / 200);
}

} // namespace
} // namespace abut::test
