// Frames of simulations equal those of another reader, and are unchanged by writing.

#include <abut/frame.h>
#include <abut/scene.h>

#include "tests/support/folder.h"
#include "tests/support/paths.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

namespace abut::test {
namespace {

struct Simulation {
    std::string name;
    std::size_t vertices, triangles;
    friend std::ostream& operator<<(std::ostream& stream, const Simulation& simulation) {
        return stream << simulation.name;
    }
};

class SimulatedFrame : public testing::TestWithParam<Simulation> {
protected:
    std::string path_ = std::string(ABUT_SHARED_DATA) + "/ccd/frames/" + GetParam().name + ".ply";

    void SetUp() override {
        if (!std::filesystem::exists(path_))
            GTEST_SKIP() << path_ << " is not there";
    }
};

TEST_P(SimulatedFrame, HasTheTrianglesThatAssimpReads) {
    const Mesh frame = read_frame(path_);
    EXPECT_EQ(frame.positions.size(), GetParam().vertices);
    ASSERT_EQ(frame.triangles.size(), GetParam().triangles);
    const Mesh joined = read_mesh(path_);
    ASSERT_EQ(joined.triangles.size(), frame.triangles.size());
    for (std::size_t i = 0; i < frame.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(frame.positions[frame.triangles[i].at(k)],
                      joined.positions[joined.triangles[i].at(k)])
                << i << ' ' << k;
}

TEST_P(SimulatedFrame, SurvivesWriting) {
    const Mesh frame = read_frame(path_);
    const Folder folder;
    write_frame(frame, folder / "frame.ply");
    const Mesh same = read_frame(folder / "frame.ply");
    EXPECT_TRUE(same.positions == frame.positions);
    EXPECT_TRUE(same.triangles == frame.triangles);
}

INSTANTIATE_TEST_SUITE_P(Simulations, SimulatedFrame,
                         testing::Values(Simulation{"cloth-ball-92", 46598, 92230},
                                         Simulation{"cloth-ball-93", 46598, 92230},
                                         Simulation{"balls16-18", 73960, 146480},
                                         Simulation{"balls16-19", 73960, 146480}));

} // namespace
} // namespace abut::test
