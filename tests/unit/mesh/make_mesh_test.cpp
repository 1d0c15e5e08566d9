/// Meshes made from other programs' arrays.
#include <abut/error.h>
#include <abut/make_mesh.h>

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace abut {
namespace {

template <typename Types>
class MakeMesh : public ::testing::Test {};

template <typename Number, typename Index>
struct Of {
    using number = Number;
    using index = Index;
};
using Kinds = ::testing::Types<Of<double, std::uint32_t>, Of<double, std::int32_t>,
                               Of<float, std::uint32_t>, Of<float, std::int32_t>>;
TYPED_TEST_SUITE(MakeMesh, Kinds);

std::string message_of(const auto& make) {
    try {
        make();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_mesh);
        return error.what();
    }
    return "";
}

TYPED_TEST(MakeMesh, TakesVectorsAndArrays) {
    using Number = typename TypeParam::number;
    using Index = typename TypeParam::index;
    const std::vector<Number> positions{0, 0, 0, Number(0.1), 2, 3, 4, -5, 6, 7, 8, 9};
    const std::array<Index, 6> indices{0, 1, 2, 3, 2, 1};
    const Mesh mesh = make_mesh(positions, indices);
    ASSERT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.positions[1], (Vec3{static_cast<double>(Number(0.1)), 2, 3}));
    EXPECT_EQ(mesh.positions[2], (Vec3{4, -5, 6}));
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{3, 2, 1}));
}

TYPED_TEST(MakeMesh, RefusesWrongLengthsAndIndices) {
    using Number = typename TypeParam::number;
    using Index = typename TypeParam::index;
    const std::vector<Number> positions(9, 1), broken(10, 1);
    const auto make = [](const std::vector<Number>& p, const std::vector<Index>& i) {
        return message_of([&] { make_mesh(p, i); });
    };
    EXPECT_EQ(make(positions, {0, 1, 2}), "");
    EXPECT_NE(make(broken, {0, 1, 2}).find("10 numbers"), std::string::npos);
    EXPECT_NE(make(positions, {0, 1, 2, 0}).find("4 indices"), std::string::npos);
    EXPECT_EQ(make(positions, {0, 1, 2, 0, 1, 3}), "index 5 is 3 of 3 vertices");
    const Index worst = std::is_signed_v<Index> ? std::numeric_limits<Index>::min()
                                                : std::numeric_limits<Index>::max();
    EXPECT_NE(make(positions, {worst, 1, 2}).find("index 0 is "), std::string::npos);
    EXPECT_NE(make({}, {0, 0, 0}).find("of 0 vertices"), std::string::npos);
    EXPECT_EQ(make({}, {}), "");
}

} // namespace
} // namespace abut
