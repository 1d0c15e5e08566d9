// A world in which nothing moves takes no memory. This file replaces the operators new of its program, to
// count their calls.

#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/shapes.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <vector>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ABUT_COUNTS_ALLOCATIONS

namespace {

std::atomic<std::int64_t> allocations{0};

void* counted(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* const memory =
            std::malloc(size > 0 ? size : 1)) // NOLINT(cppcoreguidelines-no-malloc)
        return memory;
    throw std::bad_alloc();
}

} // namespace

void* operator new(std::size_t size) {
    return counted(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
#endif

namespace abut::test {
namespace {

TEST(Allocations, AStepWithoutMotionMakesNone) {
#ifndef ABUT_COUNTS_ALLOCATIONS
    GTEST_SKIP() << "a sanitizer has its own memory";
#else
    for (const int threads : {1, 2}) {
        set_threads(threads);
        World world;
        world.add(Model(grid_mesh(40, 40, false, false,
                                  [](double u, double v) {
                                      return Vec3{40 * u - 20, 40 * v - 20, 0};
                                  })),
                  {});
        const Box3 box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
        const Mesh mesh = box_mesh(box.lower, box.upper);
        for (int i = 0; i < 20; ++i) {
            const auto place = [&](double y) {
                return Pose{{-18 + 1.2 * i, y, 0.499}, {1, 0, 0, 0}};
            };
            world.add(box, place(0)), world.add(Convex(mesh), place(2));
            world.add(Model(mesh), place(4)), world.add(Sphere{{}, 0.5}, place(6));
            world.add(Capsule{{{-0.3, 0, -0.4}, {0.3, 0, -0.4}}, 0.1}, place(8));
        }
        std::vector<ContactManifold> manifolds;
        std::vector<BodyPair> pairs;
        std::vector<std::int64_t> counts;
        for (int step = 0; step < 44; ++step) {
            const std::int64_t before = allocations;
            world.contact_manifolds(manifolds, 0.01);
            // The first steps make the memory that the others use again.
            if (step >= 4)
                counts.push_back(allocations.load() - before);
        }
        // Of several threads, each makes its own when it first helps, in whichever step that is.
        std::sort(counts.begin(), counts.end());
        EXPECT_EQ(threads == 1 ? counts.back() : counts[3 * counts.size() / 4], 0)
            << threads << " threads";
        EXPECT_EQ(manifolds.size(), 100U);
        world.collide(pairs);
        EXPECT_EQ(pairs.size(), 100U);
    }
    set_threads(0);
#endif
}

} // namespace
} // namespace abut::test
