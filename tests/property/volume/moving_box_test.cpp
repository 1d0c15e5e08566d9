// Pairs of moving boxes that overlap until a time, against boxes at many times.

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "volume/moving_box.h"

#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

/// A run of random boxes, with its storage.
struct Boxes {
    std::vector<float> rows;
    std::vector<std::uint32_t> ids;

    Boxes(Random& random, std::uint32_t count, bool on_lattice, double scale)
        : rows(MovingBoxRun::kRows * count + MovingBoxRun::kPadding), ids(count) {
        for (std::uint32_t k = 0; k < count; ++k) {
            ids[k] = k;
            for (const StepEnd end : kStepEnds) {
                const Vec3 low = on_lattice ? random.on_lattice(6) : random.in_cube(3),
                           size = on_lattice ? random.on_lattice(1) : random.in_cube(0.5);
                const auto along = [&](double from, double length) {
                    return std::pair(scale * from, scale * (from + std::abs(length)));
                };
                const auto [x0, x1] = along(low.x, size.x);
                const auto [y0, y1] = along(low.y, size.y);
                const auto [z0, z1] = along(low.z, size.z);
                set_bounds(rows.data() + first_bound(end, count, k), count,
                           Aabb(Box3{{x0, y0, z0}, {x1, y1, z1}}));
            }
        }
    }
    [[nodiscard]] MovingBoxRun run() const {
        return {rows.data(), ids.data(), static_cast<std::uint32_t>(ids.size())};
    }
    [[nodiscard]] MovingBox box(std::uint32_t k) const {
        return {bounds_from(rows.data() + first_bound(StepEnd::start, ids.size(), k), ids.size()),
                bounds_from(rows.data() + first_bound(StepEnd::end, ids.size(), k), ids.size())};
    }
};

/// Whether two boxes are within the margin at a time, along each axis on its own.
bool within_at(const MovingBox& a, const MovingBox& b, double margin, double t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto gap = [&](const MovingBox& low, const MovingBox& high) {
            return (1 - t) * (double{high.start.lower[i]} - double{low.start.upper[i]}) +
                   t * (double{high.end.lower[i]} - double{low.end.upper[i]});
        };
        if (gap(a, b) > margin || gap(b, a) > margin)
            return false;
    }
    return true;
}

TEST(MovingBoxes, NoPairThatOverlapsUntilATimeIsLost) {
    for_each_simd_target([&](const std::string& name) {
        Random random(7);
        std::size_t pairs = 0, until_bits = 0, all_bits = 0;
        for (int round = 0; round < many(2000); ++round) {
            const double scale = round % 5 == 0 ? std::ldexp(1, random.integer(-60, 60)) : 1;
            const bool on_lattice = round % 2 == 0;
            const Boxes a(random, std::uint32_t(random.integer(1, 12)), on_lattice, scale),
                b(random, std::uint32_t(random.integer(1, 12)), on_lattice, scale);
            const auto margin = float(random.chance(0.5) ? 0 : scale * random.integer(0, 2));
            // Lattice boxes meet at fractions of small integers, to the bit.
            const auto until = float(round % 7 == 0 ? 0.0
                                     : on_lattice   ? random.integer(1, 12) / 12.0
                                                    : random.uniform(0, 1));
            RunOverlaps until_time{a.run(), b.run(), {}}, all{a.run(), b.run(), {}};
            find_overlaps({&until_time, 1}, margin, until);
            find_overlaps({&all, 1}, margin);
            std::vector<std::vector<bool>> bits(12, std::vector<bool>(12)), any = bits;
            until_time.for_each([&](auto k, auto i) { bits[k][i] = true; });
            all.for_each([&](auto k, auto i) { any[k][i] = true; });
            for (std::uint32_t k = 0; k < a.ids.size(); ++k)
                for (std::uint32_t i = 0; i < b.ids.size(); ++i) {
                    ++pairs;
                    until_bits += bits[k][i] ? 1 : 0;
                    all_bits += any[k][i] ? 1 : 0;
                    for (int step = 0; step <= 24; ++step) {
                        const double t = double{until} * step / 24;
                        if (within_at(a.box(k), b.box(i), margin, t)) {
                            ASSERT_TRUE(bits[k][i]) << name << " at " << t << " until " << until;
                        }
                    }
                }
        }
        std::cout << name << ": " << pairs << " pairs, " << until_bits << " until a time, "
                  << all_bits << " at any\n";
        EXPECT_GT(until_bits, pairs / 100);
        EXPECT_LT(10 * until_bits, 9 * all_bits);
    });
}

} // namespace
} // namespace abut::test
