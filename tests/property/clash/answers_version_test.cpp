// The version of the answers grows when they change.

#include "tests/support/classified_pair.h"
#include "tests/support/shapes.h"
#include "tests/support/solids.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <string>

namespace abut::test {
namespace {

/// Numbers that are the same with every standard library.
class Choices {
public:
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    /// A multiple of an eighth from -1 to 1.
    double eighths() { return (double(below(17)) - 8) / 8; }
    /// From -1 to 1.
    double any() { return double(below(2'000'001)) * 1e-6 - 1; }

private:
    std::mt19937_64 engine_{20261128};
};

/// A flat open sheet of two triangles.
Mesh plate(double width, double depth) {
    return {{{0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

Mesh body(Choices& choices) {
    switch (choices.below(8)) {
    case 0:
        return box_mesh({-1, -0.5, 0}, {1, 0.5, 1});
    case 1:
        return open_box_mesh({-0.5, -0.5, -0.5}, {0.5, 1, 1});
    case 2:
        return plate(2, 1.5);
    case 3:
        return prism_mesh(-1, 1, 0.75, 11);
    case 4:
        return ring_mesh(-1, 1, 0.5, 0.75, 16);
    case 5:
        return gear_mesh(9, 0.5, 0.75, 0.25);
    case 6: // a solid and a sheet
        return joined(box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), plate(1.5, 2));
    default: // two solids that overlap
        return joined(box_mesh({-1, -0.25, -0.25}, {1, 0.25, 0.25}),
                      box_mesh({-0.25, -1, -0.25}, {0.25, 1, 0.25}));
    }
}

/// A place on a grid, upright; or any place, turned about any axis.
Transform place(Choices& choices) {
    Pose pose;
    if (choices.below(2) == 0) {
        pose.translation = {choices.eighths(), choices.eighths(), choices.eighths()};
    } else {
        pose.translation = {choices.any(), choices.any(), choices.any()};
        const Vec3 axis = normalized_or_zero({choices.any(), choices.any(), choices.any()});
        pose.rotation = {0.8, 0.6 * axis.x, 0.6 * axis.y, 0.6 * axis.z};
    }
    return pose;
}

std::string in_words(const std::optional<Clash>& clash) {
    if (!clash)
        return "none";
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s %.3g %.3g", to_string(clash->kind), clash->distance,
                  clash->volume);
    return text.data();
}

TEST(AnswersVersion, GrowsWithEveryChangeOfAnAnswer) {
    Choices choices;
    std::uint64_t fingerprint = 1469598103934665603U;
    std::array<int, 8> kinds{};
    for (int round = 0; round < 600; ++round) {
        const Mesh a = body(choices), b = body(choices);
        const Transform world_a = place(choices), world_b = place(choices);
        const double touch = std::array{0.0, 1e-5, 1e-3, 0.05}.at(choices.below(4));
        const auto clash = classified(a, b, touch, world_a, world_b, 0.1);
        ++kinds.at(clash ? static_cast<std::size_t>(clash->kind) + 1 : 0);
        for (const char c : in_words(clash))
            fingerprint = (fingerprint ^ static_cast<unsigned char>(c)) * 1099511628211U;
    }
    EXPECT_GT(kinds[0], 20);
    EXPECT_GT(kinds[1], 100);
    EXPECT_GT(kinds[2], 10);
    EXPECT_EQ(std::pair(kAnswersVersion, fingerprint),
              std::pair(std::int64_t{2}, std::uint64_t{11086674621126787612U}))
        << "Answers have changed: raise kAnswersVersion, and write both numbers here. Stores test "
           "all pairs again then.";
}

} // namespace
} // namespace abut::test
