#include "suites/far_apart_rows.h"

#include <abut/model.h>
#include <abut/rigid.h>

#include "measure.h"
#include "peers/peer_rigid.h"
#include "scenes/random.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <vector>

namespace abut::bench {

namespace {

constexpr int kPlateCells = 64; ///< along a side: 8,192 triangles
constexpr double kRoughness = 1e-4;
/// A round of ours repeats the query until it has taken this long.
constexpr double kLeastSeconds = 0.01;
/// Seconds that the peer gets for each of its bounding volumes: rough plates far apart take it long.
constexpr double kMostSeconds = 2;

/// A plate of 2 m by 2 m.
Mesh uneven_plate(double roughness, std::uint64_t seed) {
    scenes::Random random(seed);
    Mesh m;
    constexpr std::uint32_t kRow = kPlateCells + 1;
    for (std::uint32_t i = 0; i < kRow; ++i)
        for (std::uint32_t j = 0; j < kRow; ++j)
            m.positions.push_back({2.0 * i / kPlateCells - 1, 2.0 * j / kPlateCells - 1,
                                   roughness * random.uniform(-1, 1)});
    for (std::uint32_t i = 0; i < kPlateCells; ++i)
        for (std::uint32_t j = 0; j < kPlateCells; ++j) {
            const std::uint32_t a = i * kRow + j;
            m.triangles.push_back({a, a + kRow, a + kRow + 1});
            m.triangles.push_back({a, a + kRow + 1, a + 1});
        }
    return m;
}

/// The seconds of one call: the least of a few, or of one that takes long.
template <typename Query>
double seconds_of(double limit, const Query& query) {
    double least = 0, all = 0;
    for (int i = 0; i == 0 || (all < limit && i < 1000); ++i) {
        const double start = wall_seconds();
        query();
        const double seconds = wall_seconds() - start;
        all += seconds;
        least = i == 0 ? seconds : std::min(least, seconds);
    }
    return least;
}

void add_row(double roughness, double apart, int rounds, bool alone, Report& report) {
    const Mesh mesh_a = uneven_plate(roughness, 1), mesh_b = uneven_plate(roughness, 2);
    const Model a(mesh_a), b(mesh_b);
    PosedPair poses;
    poses.b.m[11] = apart;
    RigidPeer* best = nullptr;
    auto peers = alone ? std::vector<std::unique_ptr<RigidPeer>>{} : make_fcl_peers(mesh_a, mesh_b);
    double least = 0;
    for (const auto& peer : peers) {
        if (!peer->answers(RigidQuery::distance))
            continue;
        peer->place(poses);
        const double seconds =
            seconds_of(kLeastSeconds, [&] { (void)peer->run(RigidQuery::distance, poses, 0); });
        if (best == nullptr || seconds < least)
            best = peer.get(), least = seconds;
        if (seconds > kMostSeconds)
            report.notes.push_back(
                fmt::format("{} takes {:.3g} s at {} m", peer->name(), seconds, apart));
    }
    std::vector<double> ours, theirs;
    Gap gap;
    double their_distance = 0;
    for (int round = 0; round < rounds; ++round) {
        ours.push_back(1e6 *
                       seconds_of(kLeastSeconds, [&] { gap = distance(a, poses.a, b, poses.b); }));
        if (best != nullptr)
            theirs.push_back(1e6 * seconds_of(kLeastSeconds, [&] {
                                 their_distance = best->run(RigidQuery::distance, poses, 0);
                             }));
    }
    Row row{fmt::format("distance, {} plates {} m apart", roughness > 0 ? "rough" : "flat", apart),
            median(ours),
            {},
            {},
            "us",
            1,
            {}};
    if (best != nullptr) {
        row.peer = best->name(), row.theirs = median(theirs);
        row.counters["difference"] = gap.distance - their_distance;
    }
    row.counters["volume tests"] = static_cast<double>(gap.counters.volume_tests);
    row.counters["triangle tests"] = static_cast<double>(gap.counters.primitive_tests);
    report.rows.push_back(row);
}

} // namespace

void add_far_apart_rows(int rounds, bool alone, Report& report) {
    for (const double roughness : {0.0, kRoughness})
        for (const double apart : {1.0, 10.0, 100.0, 1e3, 1e4})
            add_row(roughness, apart, rounds, alone, report);
}

} // namespace abut::bench
