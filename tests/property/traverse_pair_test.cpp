// A traversal of two trees against all pairs of boxes: none within the bound may be lost.

#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"
#include "tree/traverse_pair.h"

#include <gtest/gtest.h>
#include <set>

namespace abut::test {
namespace {

/// Triangles in the model's frame, and their tree.
struct Primitives {
    std::vector<Triangle> triangles;
    Tree tree;

    Primitives(Random& random, int count, const Vec3& middle, double scale) {
        std::vector<Vec3> positions;
        std::vector<std::array<std::uint32_t, 3>> indices;
        for (int i = 0; i < count; ++i) {
            const Vec3 p = middle + random.in_cube(scale);
            const double size = scale * std::pow(10, random.uniform(-2.5, 0));
            triangles.push_back({p, p + random.in_cube(size), p + random.in_cube(size)});
            const auto first = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), triangles.back().begin(), triangles.back().end());
            indices.push_back({first, first + 1, first + 2});
        }
        tree = build_tree(TreeMesh{positions, indices});
    }
};

Box3 world_box(const Triangle& t, const Transform& world) {
    Box3 box;
    for (const Vec3& p : t)
        extend(box, apply(world, p));
    return box;
}

/// Squared distance of the world vertices: an upper bound of the triangles' distance, cheap.
double vertex_distance_sq(const Triangle& a, const Transform& world_a, const Triangle& b,
                          const Transform& world_b) {
    double best = HUGE_VAL;
    for (const Vec3& p : a)
        for (const Vec3& q : b)
            best = std::min(best, length_sq(apply(world_a, p) - apply(world_b, q)));
    return best;
}

TriangleContact contact_of(const Triangle& a, const Transform& world_a, const Triangle& b,
                           const Transform& world_b) {
    return overlap(world_box(a, world_a), world_box(b, world_b))
               ? triangle_triangle_intersect(
                     {apply(world_a, a[0]), apply(world_a, a[1]), apply(world_a, a[2])},
                     {apply(world_b, b[0]), apply(world_b, b[1]), apply(world_b, b[2])})
               : TriangleContact::none;
}

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class Recorder : public LeafPairVisitor {
public:
    Recorder(const Tree& a, const Tree& b, double bound_sq, const Vec3& direction = {})
        : a_(a), b_(b), bound_sq_(bound_sq), direction_(direction) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        EXPECT_NE(pairs.any(), 0U);
        EXPECT_EQ(pairs.cross & pairs.may_meet, 0U);
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i)
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j) {
                const std::pair pair{a_.order[leaf_a.first() + i], b_.order[leaf_b.first() + j]};
                if ((pairs.any() >> (4 * i + j) & 1U) != 0)
                    seen.insert(pair);
                if ((pairs.cross >> (4 * i + j) & 1U) != 0)
                    cross.insert(pair);
            }
        return bound_sq_;
    }
    [[nodiscard]] Vec3 direction() const override { return direction_; }
    PairSet seen, cross;

private:
    const Tree& a_;
    const Tree& b_;
    double bound_sq_;
    Vec3 direction_;
};

struct Kind {
    const char* name;
    double reach;        ///< of translations
    double size;         ///< of both models
    double model_offset; ///< of the models from their own origins
    bool affine;
};

Transform placement(Random& random, const Kind& kind) {
    Transform t = random.pose(0);
    if (kind.affine) {
        const double mirror = random.chance(0.5) ? -1 : 1;
        t = compose(t, Transform({mirror * random.uniform(0.2, 3), random.uniform(-1, 1), 0,
                                  random.uniform(-1, 1), random.uniform(0.2, 3), 0, 0,
                                  random.uniform(-1, 1), random.uniform(0.2, 3), 0, 0, 0}));
    }
    return t;
}

class TraversePair : public testing::TestWithParam<Kind> {};

TEST_P(TraversePair, VisitsEveryPairWithinTheBound) {
    const Kind& kind = GetParam();
    for_each_simd_target([&](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(901);
        std::size_t within = 0, visited = 0, total = 0, met = 0, crossed = 0, accepted = 0;
        for (int round = 0; round < 12; ++round) {
            const Vec3 offset_a = random.in_cube(kind.model_offset),
                       offset_b = random.in_cube(kind.model_offset);
            const Primitives a(random, 250, offset_a, kind.size),
                b(random, 250, offset_b, kind.size);
            // Both near one place of the world.
            const Vec3 place = random.in_cube(kind.reach);
            Transform world_a = placement(random, kind), world_b = placement(random, kind);
            const auto put = [&](Transform& t, const Vec3& middle, const Vec3& at) {
                const Vec3 shift = at - apply_linear(t, middle);
                t.m[9] = shift.x, t.m[10] = shift.y, t.m[11] = shift.z;
            };
            put(world_a, offset_a, place);
            put(world_b, offset_b, place + random.in_cube(0.8 * kind.size));
            const PairFrame frame = make_pair_frame(a.tree, world_a, b.tree, world_b);
            ASSERT_TRUE(frame.valid);
            PairTraversal contacts{a.tree, b.tree, frame};
            Recorder touched(a.tree, b.tree, 0);
            EXPECT_EQ(traverse_contacts(contacts, touched), Verdict::done);
            for (std::uint32_t i = 0; i < a.triangles.size(); ++i)
                for (std::uint32_t j = 0; j < b.triangles.size(); ++j) {
                    const TriangleContact contact =
                        contact_of(a.triangles[i], world_a, b.triangles[j], world_b);
                    met += contact != TriangleContact::none ? 1 : 0;
                    ASSERT_TRUE(contact == TriangleContact::none || touched.seen.contains({i, j}));
                    if (touched.cross.contains({i, j})) {
                        ++crossed;
                        ASSERT_EQ(contact, TriangleContact::cross);
                    }
                }
            for (const double bound : {0.01 * kind.size, 0.1 * kind.size, 3 * kind.size}) {
                PairTraversal depth{a.tree, b.tree, frame, bound * bound}, best = depth,
                                                                           along = depth;
                Recorder in_depth(a.tree, b.tree, bound * bound),
                    nearest_first(a.tree, b.tree, bound * bound),
                    directed(a.tree, b.tree, bound * bound, random.direction());
                const Verdict verdict = traverse_within(depth, in_depth);
                const bool all_pairs = bound > kind.size; // slow to record
                if (!all_pairs) {
                    EXPECT_EQ(traverse_nearest(best, nearest_first), Verdict::done);
                    EXPECT_EQ(traverse_nearest(along, directed), Verdict::done);
                }
                bool any = false;
                for (std::uint32_t i = 0; i < a.triangles.size(); ++i)
                    for (std::uint32_t j = 0; j < b.triangles.size(); ++j) {
                        if (vertex_distance_sq(a.triangles[i], world_a, b.triangles[j], world_b) >
                            bound * bound)
                            continue;
                        ++within;
                        any = true;
                        ASSERT_TRUE(verdict == Verdict::accepted || in_depth.seen.contains({i, j}));
                        if (all_pairs)
                            continue;
                        ASSERT_TRUE(nearest_first.seen.contains({i, j})) << "bound " << bound;
                        ASSERT_TRUE(directed.seen.contains({i, j})) << "bound " << bound;
                    }
                if (verdict == Verdict::accepted) {
                    ++accepted;
                    ASSERT_TRUE(any);
                }
                if (all_pairs)
                    continue;
                visited += nearest_first.seen.size();
                total += a.triangles.size() * b.triangles.size();
            }
        }
        EXPECT_GT(met, 100U);
        EXPECT_GT(crossed, met * 8 / 10); // told without exact arithmetic
        EXPECT_GT(accepted, 0U);
        EXPECT_GT(within, 300U);
        EXPECT_LT(visited, total / 2);
    });
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TraversePair,
    testing::Values(Kind{"rigid", 10, 1, 0, false}, Kind{"affine", 10, 1, 0, true},
                    Kind{"far in the world", 1e5, 1, 0, false}, Kind{"far affine", 1e5, 1, 0, true},
                    Kind{"far in the model", 10, 1, 1e3, false}, Kind{"tiny", 0, 1e-6, 0, true},
                    Kind{"huge", 1e6, 1e6, 0, true}),
    [](const auto& tested) {
        std::string name = tested.param.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        return name;
    });

} // namespace
} // namespace abut::test
