#include "suites/curved_rows.h"

#include <abut/world.h>

#include "measure.h"
#include "peers/peer_curved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

constexpr int kRounds = 9;
constexpr std::array kNames{"cylinders", "cones", "ellipsoids"};

/// Random shapes of one kind, and random poses at which each meets the boxes of about ten others.
class CurvedScene {
public:
    CurvedScene(std::size_t kind, std::size_t bodies, std::uint64_t seed) : random_(seed) {
        for (std::size_t i = 0; i < bodies; ++i) {
            const double radius = uniform(0.3, 1), half = uniform(0.3, 1);
            if (kind == 0)
                shapes.emplace_back(Cylinder{{{0, 0, -half}, {0, 0, half}}, radius});
            else if (kind == 1)
                shapes.emplace_back(Cone{{0, 0, half}, {0, 0, -half}, radius});
            else
                shapes.emplace_back(Ellipsoid{{}, {radius, uniform(0.3, 1), half}});
        }
        half_ = std::cbrt(static_cast<double>(bodies) / 2);
    }

    std::vector<Pose> poses() {
        std::vector<Pose> result(shapes.size());
        for (Pose& pose : result)
            pose = {{uniform(-half_, half_), uniform(-half_, half_), uniform(-half_, half_)},
                    {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.01, 1)}};
        return result;
    }

    std::vector<CurvedShapeOfPeer> shapes;

private:
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    std::mt19937_64 random_;
    double half_ = 0;
};

/// Seconds of one query on all pairs, round by round, and how often the peer answers otherwise.
struct QueryTimes {
    std::vector<double> ours, theirs;
    double found = 0, differ = 0, largest_difference = 0;
};

/// Measures both queries on pairs of boxes.
class CurvedQueries {
public:
    CurvedQueries(World& world, CurvedPeer* peer) : world_(world), peer_(peer) {}

    void run(const std::vector<Pose>& poses) {
        const std::vector<BodyPair> near = world_.pairs();
        pairs_ = static_cast<double>(near.size());
        double start = process_seconds();
        const std::vector<BodyPair> met = world_.collide();
        contact_.ours.push_back(process_seconds() - start);
        start = process_seconds();
        const std::vector<BodyGap> deep = world_.penetration();
        depth_.ours.push_back(process_seconds() - start);
        contact_.found = static_cast<double>(met.size());
        depth_.found = static_cast<double>(deep.size());
        if (peer_ != nullptr)
            run_peer(poses, near, deep);
    }
    void add_rows(Report& report, const std::string& name) const {
        add_row(report, name + ", contacts", contact_);
        add_row(report, name + ", depths", depth_);
    }

private:
    void run_peer(const std::vector<Pose>& poses, const std::vector<BodyPair>& near,
                  const std::vector<BodyGap>& deep) {
        peer_->set_poses(poses);
        double found = 0;
        double start = process_seconds();
        for (const BodyPair& pair : near)
            found += peer_->collide(pair.a.index, pair.b.index) ? 1 : 0;
        contact_.theirs.push_back(process_seconds() - start);
        contact_.differ += std::abs(found - contact_.found);
        // Only of the pairs that meet, which ours has to find.
        std::vector<double> depths(deep.size());
        start = process_seconds();
        for (std::size_t i = 0; i < deep.size(); ++i)
            depths[i] = peer_->signed_distance(deep[i].a.index, deep[i].b.index);
        depth_.theirs.push_back(process_seconds() - start);
        for (std::size_t i = 0; i < deep.size(); ++i)
            depth_.largest_difference =
                std::max(depth_.largest_difference, std::abs(depths[i] - deep[i].distance));
    }
    void add_row(Report& report, const std::string& name, const QueryTimes& times) const {
        Row row{name,
                1e3 * median(times.ours),
                peer_ != nullptr ? peer_->name() : "",
                {},
                "ms",
                1,
                {{"pairs", pairs_}, {"meet", times.found}}};
        if (peer_ != nullptr)
            row.theirs = 1e3 * median(times.theirs);
        if (times.differ > 0)
            row.counters["contacts that differ"] = times.differ;
        if (times.largest_difference > 0)
            row.counters["largest difference"] = times.largest_difference;
        report.rows.push_back(row);
    }

    World& world_;
    CurvedPeer* peer_;
    double pairs_ = 0;
    QueryTimes contact_, depth_;
};

} // namespace

void add_curved_rows(Report& report, std::size_t bodies, std::uint64_t seed) {
    for (std::size_t kind = 0; kind < kNames.size(); ++kind) {
        CurvedScene scene(kind, bodies, seed);
        World world;
        std::vector<BodyId> ids;
        ids.reserve(scene.shapes.size());
        for (const CurvedShapeOfPeer& shape : scene.shapes)
            ids.push_back(std::visit([&](const auto& s) { return world.add(s, {}); }, shape));
        const auto peer = make_fcl_curved(scene.shapes);
        CurvedQueries queries(world, peer.get());
        for (int round = 0; round < kRounds; ++round) {
            const std::vector<Pose> poses = scene.poses();
            for (std::size_t i = 0; i < ids.size(); ++i)
                world.move(ids[i], poses[i]);
            world.update();
            queries.run(poses);
        }
        queries.add_rows(report, kNames[kind]);
    }
}

} // namespace abut::bench
