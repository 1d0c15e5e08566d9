// Compounds: each answer of a world of compounds is that of a world in which every piece is a body.

#include <abut/compound.h>
#include <abut/error.h>
#include <abut/vector.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

struct PieceOfTest {
    AnyShape shape;
    Pose pose;
};

Pose product(const Pose& outer, const Pose& inner) {
    const auto &p = outer.rotation, &q = inner.rotation;
    const Transform turn = Pose{{}, p};
    return {outer.translation + apply(turn, inner.translation),
            {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
             p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
             p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3],
             p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1]}};
}

RigidShape rigid_shape(const AnyShape& shape) {
    return std::visit([](const auto& each) { return RigidShape(each); }, shape);
}

/// The same bodies twice: as compounds, and piece by piece.
class TwinWorlds {
public:
    TwinWorlds()
        : single({BroadPhaseMethod::automatic, [this](BodyId a, BodyId b) {
                      return piece_of.at(a.index).first != piece_of.at(b.index).first;
                  }}) {}

    std::size_t add_body(const std::vector<PieceOfTest>& pieces, const Pose& pose,
                         const BodyOptions& options = {}) {
        std::vector<Compound::Piece> of_compound;
        of_compound.reserve(pieces.size());
        for (const PieceOfTest& each : pieces)
            of_compound.push_back({rigid_shape(each.shape), each.pose});
        const std::size_t number = ids.size();
        ids.push_back(whole.add(Compound(of_compound), pose, options));
        number_of[ids.back().index] = number;
        alive.push_back(true);
        bodies.push_back(pieces);
        single_ids.emplace_back();
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const BodyId id = std::visit(
                [&](const auto& shape) {
                    return single.add(shape, product(pose, pieces[i].pose), options);
                },
                pieces[i].shape);
            piece_of[id.index] = {number, i};
            single_ids.back().push_back(id);
        }
        return number;
    }
    void move(std::size_t number, const Pose& pose) {
        whole.move(ids[number], pose);
        for (std::size_t i = 0; i < bodies[number].size(); ++i)
            single.move(single_ids[number][i], product(pose, bodies[number][i].pose));
    }
    void remove(std::size_t number) {
        whole.remove(ids[number]);
        alive[number] = false;
        for (const BodyId id : single_ids[number])
            single.remove(id);
    }
    /// The numbers of the test's bodies, lower first.
    [[nodiscard]] std::pair<std::size_t, std::size_t> whole_pair(BodyId a, BodyId b) const {
        return std::minmax({number_of.at(a.index), number_of.at(b.index)});
    }
    [[nodiscard]] std::pair<std::size_t, std::size_t> single_pair(BodyId a, BodyId b) const {
        return std::minmax({piece_of.at(a.index).first, piece_of.at(b.index).first});
    }

    World whole, single;
    std::vector<std::vector<PieceOfTest>> bodies;
    std::vector<BodyId> ids;
    std::vector<bool> alive;
    std::vector<std::vector<BodyId>> single_ids;
    std::map<std::uint32_t, std::size_t> number_of;
    std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> piece_of;
};

using NumberPairs = std::set<std::pair<std::size_t, std::size_t>>;
NumberPairs of_whole(const TwinWorlds& twins, const std::vector<BodyPair>& pairs) {
    NumberPairs result;
    for (const BodyPair& pair : pairs) {
        EXPECT_LT(pair.a.index, pair.b.index);
        EXPECT_TRUE(result.insert(twins.whole_pair(pair.a, pair.b)).second) << "listed twice";
    }
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    return result;
}
NumberPairs of_single(const TwinWorlds& twins, const std::vector<BodyPair>& pairs) {
    NumberPairs result;
    for (const BodyPair& pair : pairs)
        result.insert(twins.single_pair(pair.a, pair.b));
    return result;
}

std::vector<PieceOfTest> random_pieces(Random& random) {
    static const std::vector<KindOfBody> kinds = kinds_of_bodies();
    std::vector<PieceOfTest> pieces;
    for (int i = random.integer(1, 4); i > 0; --i) {
        std::size_t kind = 0;
        do
            kind = static_cast<std::size_t>(random.integer(0, int(kinds.size()) - 1));
        while (kinds[kind].name == "half-space" || kinds[kind].name == "open model");
        Pose pose;
        if (random.chance(0.8))
            pose = random.pose(1);
        pieces.push_back({kinds[kind].shape, pose});
    }
    return pieces;
}

void expect_same_gaps(const TwinWorlds& twins, const std::vector<BodyGap>& found,
                      const std::vector<BodyGap>& truth) {
    std::map<std::pair<std::size_t, std::size_t>, double> least;
    for (const BodyGap& gap : truth) {
        const auto [place, is_new] =
            least.try_emplace(twins.single_pair(gap.a, gap.b), gap.distance);
        place->second = std::min(place->second, gap.distance);
    }
    EXPECT_EQ(found.size(), least.size());
    for (const BodyGap& gap : found) {
        EXPECT_LT(gap.a.index, gap.b.index);
        // How near a depth with a model comes to the least depends on the search.
        const double error = gap.distance < 0 && gap.status == Status::bound_only ? 0.1 : 1e-9;
        EXPECT_NEAR(gap.distance, least.at(twins.whole_pair(gap.a, gap.b)), error);
        EXPECT_LT(gap.piece_a, twins.bodies[twins.number_of.at(gap.a.index)].size());
        EXPECT_LT(gap.piece_b, twins.bodies[twins.number_of.at(gap.b.index)].size());
        if (gap.normal != Vec3{}) {
            EXPECT_NEAR(length(gap.point_b - gap.point_a - gap.distance * gap.normal), 0, 1e-9);
        }
    }
}

TEST(Compounds, AnswerAsTheirPieces) {
    Random random(3320);
    int met = 0, near = 0, began = 0, ended = 0, points = 0, impacts = 0, hits = 0, overlaps = 0;
    for (int round = 0; round < many(40); ++round) {
        TwinWorlds twins;
        for (int i = 0; i < 6; ++i)
            twins.add_body(random_pieces(random), random.pose(3.5),
                           {.user_data = static_cast<std::uint64_t>(100 + i)});
        NumberPairs before;
        for (int step = 0; step < 4; ++step) {
            if (step == 2) { // a new body takes the places of one that is gone
                twins.remove(1);
                twins.add_body(random_pieces(random), random.pose(3.5), {.user_data = 106});
            }
            for (std::size_t i = 0; i < twins.ids.size(); ++i)
                if (twins.alive[i] && (i == 0 || random.chance(0.5)))
                    twins.move(i, random.pose(3.5));
            const NumberPairs meeting = of_whole(twins, twins.whole.collide());
            EXPECT_EQ(meeting, of_single(twins, twins.single.collide())) << round << ' ' << step;
            met += static_cast<int>(meeting.size());
            const NumberPairs boxes = of_whole(twins, twins.whole.pairs()),
                              begun = of_whole(twins, twins.whole.begun()),
                              over = of_whole(twins, twins.whole.ended());
            if (step != 2) { // the numbers of removed bodies are not told apart below
                NumberPairs now = before;
                now.insert(begun.begin(), begun.end());
                for (const auto& pair : over)
                    EXPECT_EQ(now.erase(pair), 1U);
                EXPECT_EQ(now, boxes);
                for (const auto& pair : begun)
                    EXPECT_FALSE(before.contains(pair));
            }
            before = boxes;
            began += static_cast<int>(begun.size()), ended += static_cast<int>(over.size());
            expect_same_gaps(twins, twins.whole.penetration(), twins.single.penetration());
            const auto gaps = twins.whole.within(0.3);
            near += static_cast<int>(gaps.size());
            expect_same_gaps(twins, gaps, twins.single.within(0.3));

            const double margin = random.chance(0.5) ? 0.05 : 0;
            const auto manifolds = twins.whole.contact_manifolds(margin);
            std::set<std::array<std::uint32_t, 5>> names;
            NumberPairs in_contact, truly_in_contact;
            for (const ContactManifold& m : twins.single.contact_manifolds(margin))
                truly_in_contact.insert(twins.single_pair(m.a, m.b));
            for (const ContactManifold& m : manifolds) {
                EXPECT_LT(m.a.index, m.b.index);
                in_contact.insert(twins.whole_pair(m.a, m.b));
                EXPECT_TRUE(
                    names.insert({m.a.index, m.b.index, m.piece_a, m.piece_b, m.region}).second);
                EXPECT_EQ(m.user_data_a, 100 + twins.number_of.at(m.a.index));
                EXPECT_EQ(m.user_data_b, 100 + twins.number_of.at(m.b.index));
                for (std::uint32_t i = 0; i < m.count; ++i, ++points)
                    EXPECT_NEAR(dot(m.normal, m.points[i].point_a - m.points[i].point_b),
                                m.points[i].depth, 1e-9);
            }
            EXPECT_EQ(in_contact, truly_in_contact);
            const Vec3 origin = 8 * random.direction();
            const Ray ray{origin, random.in_cube(2) - origin};
            const auto on_whole = twins.whole.all_hits(ray), on_single = twins.single.all_hits(ray);
            std::map<std::size_t, double> first;
            for (const BodyRayHit& hit : on_single)
                first.try_emplace(twins.piece_of.at(hit.body.index).first, hit.t);
            EXPECT_EQ(on_whole.size(), first.size());
            for (const BodyRayHit& hit : on_whole)
                EXPECT_NEAR(hit.t, first.at(twins.number_of.at(hit.body.index)), 1e-9);
            if (!on_whole.empty()) {
                EXPECT_EQ(twins.whole.first_hit(ray).body, on_whole.front().body);
            }
            hits += static_cast<int>(on_whole.size());

            const RigidShape ball(Sphere{{}, 0.5});
            const Pose place = random.pose(3.5);
            std::set<std::size_t> of_pieces, of_bodies;
            for (const BodyId id : twins.single.overlaps(ball, place))
                of_pieces.insert(twins.piece_of.at(id.index).first);
            const std::vector<BodyId> found = twins.whole.overlaps(ball, place);
            for (const BodyId id : found)
                of_bodies.insert(twins.number_of.at(id.index));
            EXPECT_EQ(of_bodies, of_pieces);
            EXPECT_EQ(found.size(), of_bodies.size());
            overlaps += static_cast<int>(found.size());
            const Motion sweep = Motion::between(Pose{{-4, 0, 0}}, Pose{{4, 0.3, 0}});
            const BodySweepHit swept = twins.whole.sweep(ball, sweep),
                               truth = twins.single.sweep(ball, sweep);
            EXPECT_EQ(swept.meet, truth.meet);
            if (swept.meet) {
                EXPECT_NEAR(swept.impact.time, truth.impact.time, 1e-6);
            }
        }
        // Motions: the pieces turn about one centre.
        std::vector<BodyMotion> motions, of_pieces;
        for (std::size_t i = 0; i < twins.ids.size(); ++i) {
            if (!twins.alive[i])
                continue;
            const Pose start = random.pose(4);
            twins.move(i, start);
            Motion motion{start, start.translation, -1.5 * start.translation,
                          random.uniform(0, 1) * random.direction()};
            motions.push_back({twins.ids[i], motion});
            for (std::size_t k = 0; k < twins.bodies[i].size(); ++k) {
                motion.start = product(start, twins.bodies[i][k].pose);
                of_pieces.push_back({twins.single_ids[i][k], motion});
            }
        }
        std::map<std::pair<std::size_t, std::size_t>, double> first;
        for (const BodyImpact& each : twins.single.time_of_impact(of_pieces)) {
            const auto [place, is_new] =
                first.try_emplace(twins.single_pair(each.a, each.b), each.impact.time);
            place->second = std::min(place->second, each.impact.time);
        }
        const auto found = twins.whole.time_of_impact(motions);
        EXPECT_EQ(found.size(), first.size());
        for (const BodyImpact& each : found)
            EXPECT_NEAR(each.impact.time, first.at(twins.whole_pair(each.a, each.b)), 1e-4);
        impacts += static_cast<int>(found.size());
    }
    for (const int count : {met, near, began, ended, points, impacts, hits, overlaps})
        EXPECT_GT(count, many(40) / 2);
}

TEST(Compounds, SchedulesFollowAllPieces) {
    Random random(3321);
    int met = 0;
    for (int round = 0; round < many(20); ++round) {
        TwinWorlds twins;
        for (int i = 0; i < 8; ++i)
            twins.add_body(random_pieces(random), random.pose(5));
        std::vector<Pose> poses;
        std::vector<Vec3> velocities;
        twins.whole.advance(0);
        for (std::size_t i = 0; i < twins.ids.size(); ++i) {
            poses.push_back(random.pose(5)), velocities.push_back(2 * random.direction());
            twins.move(i, poses.back());
            twins.whole.set_speed(twins.ids[i], {.velocity = velocities.back()});
        }
        for (int step = 0; step < 10; ++step) {
            const double dt = 0.1;
            const double free = twins.whole.time_to_collision(twins.ids[0], twins.ids[1]);
            for (std::size_t i = 0; i < twins.ids.size(); ++i) {
                poses[i].translation = poses[i].translation + dt * velocities[i];
                twins.move(i, poses[i]);
            }
            const NumberPairs meeting = of_whole(twins, twins.whole.advance(dt));
            EXPECT_EQ(meeting, of_single(twins, twins.single.collide()));
            if (free > dt) {
                EXPECT_FALSE(meeting.contains({0, 1}));
            }
            met += static_cast<int>(meeting.size());
        }
    }
    EXPECT_GT(met, many(20));
}

TEST(Compounds, ConvexPiecesStandOnTheirCorners) {
    // An L of two bars stands on a floor with its whole foot.
    const std::vector<Vec3> outline{{0, 0, 0},     {2, 0, 0},   {2, 0.5, 0},
                                    {0.5, 0.5, 0}, {0.5, 2, 0}, {0, 2, 0}};
    const Model solid(star_prism(outline, 1));
    World world;
    const BodyId floor = world.add(Box3{{-5, -5, -1}, {5, 5, 0}}, {}, {.is_static = true});
    const BodyId body = world.add(ConvexPieces(solid), {{0, 0, 0}, {1, 0, 0, 0}}, {.user_data = 7});
    EXPECT_EQ(world.size(), 2U);
    const auto manifolds = world.contact_manifolds();
    ASSERT_FALSE(manifolds.empty());
    std::set<std::pair<double, double>> places;
    for (const ContactManifold& m : manifolds) {
        EXPECT_EQ(m.a, floor);
        EXPECT_EQ(m.b, body);
        EXPECT_EQ(m.user_data_b, 7U);
        EXPECT_NEAR(m.normal.z, 1, 1e-12);
        for (std::uint32_t i = 0; i < m.count; ++i)
            places.insert({m.points[i].point_b.x, m.points[i].point_b.y});
    }
    for (const auto& corner : {std::pair(0.0, 0.0), std::pair(2.0, 0.0), std::pair(0.0, 2.0)})
        EXPECT_TRUE(places.contains(corner)) << corner.first << ' ' << corner.second;
}

TEST(Compounds, ErrorsNameThePiece) {
    EXPECT_THROW(Compound(std::vector<Compound::Piece>{}), Error);
    std::vector<Compound::Piece> pieces{{Sphere{{}, 1}}, {Sphere{{}, 1}, {{NAN, 0, 0}}}};
    try {
        Compound compound(pieces);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("piece 1"), std::string::npos);
    }
}

TEST(Compounds, IdsOfPiecesAreNoBodies) {
    World world;
    const std::vector<Compound::Piece> pieces{{Sphere{{}, 1}}, {Sphere{{2, 0, 0}, 1}}};
    const BodyId body = world.add(Compound(pieces), {}, {.user_data = 5});
    EXPECT_EQ(world.size(), 1U);
    EXPECT_FALSE(world.is_valid({body.index + 1, 0}));
    EXPECT_TRUE(world.pairs().empty());
    EXPECT_NEAR(world.box(body).upper.x, 3, 1e-9);
    EXPECT_NEAR(world.box(body).lower.x, -1, 1e-9);
    EXPECT_EQ(world.options(body).user_data, 5U);
    world.set_user_data(body, 6);
    EXPECT_EQ(world.options(body).user_data, 6U);
    world.remove(body);
    EXPECT_EQ(world.size(), 0U);
    EXPECT_TRUE(world.collide().empty());
}

} // namespace
} // namespace abut::test
