/// Measuring of parts and points, in a walk through a store of three boxes.
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/walk.h>

#include "apps/walk/toolbox/measurement.h"
#include "store/database/store_file.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <memory>

namespace abut::viewer {
namespace {

using test::box_mesh;

/// Boxes of 1 m: b is 0.5 m beside a in x and 1.2 m above it in z; c overlaps a by 0.25 m in x.
class Measuring : public testing::Test {
protected:
    void SetUp() override {
        Scene scene;
        scene.up = UpAxis::y;
        scene.meshes = {box_mesh({0, 0, 0}, {1, 1, 1})};
        const auto add = [&](const char* id, double x, double z) {
            Transform world;
            world.m[9] = x, world.m[11] = z;
            scene.parts.push_back({id, id, "Box", 0, world, {}});
        };
        add("a", 0, 0);
        add("b", 1.5, 2.2);
        add("c", -0.75, 0);
        write_glb(scene, folder_ / "boxes.glb");
        (void)import_models({folder_ / "boxes.glb"}, folder_ / "boxes.abut");
        const Store store = open_store(folder_ / "boxes.abut");
        walk_ = std::make_unique<Walk>(store);
        store.file().for_each_part([&](const PartRow& row) { parts_.push_back({row.part}); });
        ASSERT_EQ(parts_.size(), 3U);
    }
    [[nodiscard]] PartPoint at(std::size_t part, const Vec3& point) const {
        return {parts_.at(part), point};
    }

    test::Folder folder_;
    std::unique_ptr<Walk> walk_;
    std::vector<WalkPart> parts_;
};

TEST_F(Measuring, PartsHaveTheirLeastDistance) {
    const Measurement measured = measure(*walk_, Measured::parts, at(0, {}), at(1, {}));
    EXPECT_EQ(measured.text, "1.3 m between the parts (along x 0.5, y 0, z 1.2)");
    EXPECT_NEAR(length(measured.ends[1] - measured.ends[0]), 1.3, 1e-9);
    EXPECT_NEAR(measured.ends[0].x, 1, 1e-9);
    EXPECT_NEAR(measured.ends[1].z, 2.2, 1e-9);
    // From the other side, the same.
    const Measurement back = measure(*walk_, Measured::parts, at(1, {}), at(0, {}));
    EXPECT_NEAR(length(back.ends[1] - back.ends[0]), 1.3, 1e-9);
    EXPECT_LT(back.ends[1].z, back.ends[0].z);
}

TEST_F(Measuring, PartsThatMeetHaveADepth) {
    const Measurement measured = measure(*walk_, Measured::parts, at(0, {}), at(2, {}));
    EXPECT_EQ(measured.text.rfind("the parts meet, 0.25 m deep", 0), 0U) << measured.text;
    EXPECT_NEAR(length(measured.ends[1] - measured.ends[0]), 0.25, 1e-9);
}

TEST_F(Measuring, APointIsMeasuredToThePart) {
    const Vec3 corner{1, 1, 1};
    const Measurement measured = measure(*walk_, Measured::point_part, at(0, corner), at(1, {}));
    EXPECT_EQ(measured.text, "1.3 m from the point to the part (along x 0.5, y 0, z 1.2)");
    EXPECT_EQ(measured.ends[0], corner);
    // Of the first part only the point counts; of the second one only the part.
    const Measurement middle =
        measure(*walk_, Measured::point_part, at(2, {0.5, 0.5, 0.5}), at(1, {9, 9, 9}));
    EXPECT_NEAR(length(middle.ends[1] - Vec3{1.5, 0.5, 2.2}), 0, 1e-9);
}

TEST_F(Measuring, PointsAreMeasuredWhereverTheyAre) {
    const Measurement measured =
        measure(*walk_, Measured::points, at(0, {0, 0, 1}), at(0, {3, 4, 1}));
    EXPECT_EQ(measured.text, "5 m between the points (along x 3, y 4, z 0)");
    EXPECT_EQ(measured.ends, (std::array{Vec3{0, 0, 1}, Vec3{3, 4, 1}}));
}

TEST_F(Measuring, AMovedPartIsMeasuredWhereItIs) {
    Transform world = walk_->world_from_part(parts_[1]);
    world.m[11] = 3.2; // 1 m farther
    walk_->move(parts_[1], world);
    const Measurement measured = measure(*walk_, Measured::parts, at(0, {}), at(1, {}));
    EXPECT_NEAR(measured.ends[1].z - measured.ends[0].z, 2.2, 1e-9);
    EXPECT_NEAR(measured.ends[1].x - measured.ends[0].x, 0.5, 1e-9);
}

TEST(Measured, HasNames) {
    EXPECT_STREQ(to_string(Measured::points), "points");
    EXPECT_STREQ(to_string(Measured::point_part), "point_part");
    EXPECT_STREQ(to_string(Measured::parts), "parts");
}

} // namespace
} // namespace abut::viewer
