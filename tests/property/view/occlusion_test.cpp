// Rays prove that boxes which the occlusion buffer hides cannot be seen.
#include "math/transform.h"
#include "math/vector.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/store/level_trees.h"
#include "view/selection/occlusion_buffer.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <set>
#include <vector>

namespace abut::test {
namespace {

/// A tube around the z axis from -1 to 1, open or with lids.
Mesh tube(int sides, bool closed) {
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(sides);
    for (const double z : {-1.0, 1.0})
        for (std::uint32_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            mesh.positions.push_back({std::cos(angle), std::sin(angle), z});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = (i + 1) % n;
        mesh.triangles.push_back({i, k, n + k});
        mesh.triangles.push_back({i, n + k, n + i});
        if (closed && i > 0 && i + 1 < n) {
            mesh.triangles.push_back({0, k, i});
            mesh.triangles.push_back({n, n + i, n + k});
        }
    }
    return mesh;
}

Mesh random_occluder(Random& random) {
    switch (random.integer(0, 4)) {
    case 0:
        return tube(random.integer(3, 16), random.chance(0.7));
    case 1: { // triangles that have nothing to do with each other
        Mesh mesh;
        for (std::uint32_t i = 0; i < 30; ++i) {
            mesh.positions.push_back(random.in_cube());
            if (i % 3 == 2)
                mesh.triangles.push_back({i - 2, i - 1, i});
        }
        return mesh;
    }
    case 2: { // a solid with faces left out or turned
        Mesh mesh = tube(8, true);
        for (auto& triangle : mesh.triangles)
            if (random.chance(0.2))
                std::swap(triangle[0], triangle[1]);
        mesh.triangles.resize(mesh.triangles.size() - 3);
        return mesh;
    }
    default:
        return box_mesh({-1, -1, -1}, {1, 1, 1});
    }
}

/// Returns whether the segment from the eye to a point meets a triangle, to rounding.
bool is_blocked(const Vec3& eye, const Vec3& point, const std::vector<Occluder>& occluders) {
    const auto at = [](const std::array<float, 3>& p) { return Vec3{p[0], p[1], p[2]}; };
    const Vec3 d = point - eye;
    for (const Occluder& occluder : occluders)
        for (const auto& [i, k, l] : occluder.triangles) {
            const Vec3 a = at(occluder.vertices[i]), ab = at(occluder.vertices[k]) - a,
                       ac = at(occluder.vertices[l]) - a;
            const Vec3 p = cross(d, ac);
            const double det = dot(ab, p);
            if (det == 0)
                continue;
            const Vec3 to = eye - a, q = cross(to, ab);
            const double u = dot(to, p) / det, v = dot(d, q) / det, t = dot(ac, q) / det;
            constexpr double kError = 1e-9;
            if (u >= -kError && v >= -kError && u + v <= 1 + kError && t > 0 && t < 1)
                return true;
        }
    return false;
}

/// A point of the box that is in the picture; false if a few random ones are not.
bool point_in_picture(Random& random, const Camera& camera, const Vec3& eye, const LevelNode& box,
                      Vec3& point) {
    const CameraFrame frame(camera);
    for (int tries = 0; tries < 10; ++tries) {
        point = {random.uniform(box.lower[0], box.upper[0]),
                 random.uniform(box.lower[1], box.upper[1]),
                 random.uniform(box.lower[2], box.upper[2])};
        const Vec3 d = point - eye;
        const double ahead = dot(d, frame.forward);
        if (ahead > camera.near && std::abs(dot(d, frame.right)) < frame.slope_x * ahead &&
            std::abs(dot(d, frame.up)) < frame.slope_y * ahead)
            return true;
    }
    return false;
}

std::vector<Occluder> random_occluders(Random& random) {
    std::vector<Occluder> occluders;
    for (int i = random.integer(1, 30); i > 0; --i) {
        Transform place = random.linear_map(true);
        for (std::size_t k = 0; k < 9; ++k)
            place.m.at(k) *= 3;
        const Vec3 at = random.in_cube(20);
        place.m[9] = at.x, place.m[10] = at.y, place.m[11] = at.z;
        for (const ViewChunk& chunk : make_chunks(random_occluder(random), place, 0))
            for (Occluder& occluder : find_occluders(chunk))
                occluders.push_back(std::move(occluder));
    }
    return occluders;
}

TEST(OcclusionBuffer, HidesNothingThatARayReaches) {
    Random random(141);
    int hidden = 0, blocked = 0, points = 0;
    OcclusionBuffer buffer;
    for (int i = 0; i < many(300); ++i) {
        const Vec3 origin = random.in_cube(1000);
        const std::vector<Occluder> occluders = random_occluders(random);
        Camera camera = random_camera(random, origin, 15);
        camera.near = random.uniform(0.01, 1);
        const Vec3 eye = camera.eye - origin;
        buffer.begin(camera, origin);
        for (const Occluder& occluder : occluders)
            buffer.draw(occluder);
        buffer.finish();
        for (int k = 0; k < 100; ++k) {
            LevelNode box;
            const Vec3 middle = random.in_cube(40);
            const double size = std::pow(10, random.uniform(-2, 1));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double m = component(middle, static_cast<int>(axis));
                box.lower.at(axis) = static_cast<float>(m - random.uniform(0, size));
                box.upper.at(axis) = static_cast<float>(m + random.uniform(0, size));
            }
            const bool is_hidden = buffer.hides(box.lower, box.upper);
            bool all_blocked = true, any = false;
            for (int sample = 0; sample < 20; ++sample) {
                Vec3 point;
                if (!point_in_picture(random, camera, eye, box, point))
                    break;
                any = true;
                const bool is_behind = is_blocked(eye, point, occluders);
                all_blocked = all_blocked && is_behind;
                points += is_hidden ? 1 : 0;
                ASSERT_TRUE(!is_hidden || is_behind) << "a visible point is hidden";
            }
            hidden += any && is_hidden ? 1 : 0;
            blocked += any && all_blocked ? 1 : 0;
        }
    }
    std::cout << hidden << " boxes hidden of " << blocked << " that seem to be\n";
    EXPECT_GT(hidden, many(300));
    EXPECT_GT(2 * hidden, blocked);
}

TEST(Occluder, HasTheLargestTrianglesOfAChunk) {
    Random random(142);
    for (int i = 0; i < many(100); ++i) {
        const LevelModel model = LevelModelMaker(random, {.most_triangles = 400}).make();
        const ViewChunk& chunk =
            model.chunks[static_cast<std::size_t>(random.integer(0, int(model.chunks.size()) - 1))];
        std::multiset<std::array<float, 9>> triangles;
        const auto add = [](std::multiset<std::array<float, 9>>& to, const auto& corner) {
            std::array<float, 9> one{};
            for (std::size_t k = 0; k < 9; ++k)
                one.at(k) = corner(k / 3, k % 3);
            to.insert(one);
        };
        for (std::size_t t = 0; t < chunk.indices.size(); t += 3)
            add(triangles, [&](std::size_t k, std::size_t axis) {
                return static_cast<float>(
                    chunk.lower.at(axis) +
                    double{chunk.step.at(axis)} *
                        chunk.vertices[chunk.indices[t + k]].position.at(axis));
            });
        std::size_t count = 0;
        for (const Occluder& occluder : find_occluders(chunk)) {
            ASSERT_LE(occluder.triangles.size(), 128U);
            std::multiset<std::array<float, 9>> own;
            for (const auto& triangle : occluder.triangles)
                add(own, [&](std::size_t k, std::size_t axis) {
                    return occluder.vertices[triangle.at(k)].at(axis);
                });
            ASSERT_TRUE(std::includes(triangles.begin(), triangles.end(), own.begin(), own.end()));
            count += own.size();
        }
        ASSERT_GT(count, 0U);
    }
}

} // namespace
} // namespace abut::test
