#include "suites/hard_pair_rows.h"

#include <abut/clash.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "measure.h"

#include <fmt/format.h>
#include <map>
#include <utility>

namespace abut::bench {

namespace {

constexpr double kWithin = 0.05; ///< metres

/// The hard pairs of a job, ready for single queries.
class HardPairs {
public:
    HardPairs(std::vector<Scene> scenes, const ClashReport& job) {
        into_one_frame(scenes);
        for (const Clash& clash : job.clashes)
            if (clash.kind == ClashKind::hard)
                pairs_.push_back({side(scenes, clash, 0), side(scenes, clash, 1)});
    }
    [[nodiscard]] std::size_t size() const { return pairs_.size(); }

    /// Returns how many of the pairs from `begin` to `end` meet and are near.
    [[nodiscard]] std::size_t ask(std::size_t begin, std::size_t end) const {
        std::size_t yes = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = pairs_[i];
            yes +=
                collide(*a.model, a.world, *b.model, b.world, {.mode = ContactMode::first}).meet()
                    ? 1
                    : 0;
            yes += within(*a.model, a.world, *b.model, b.world, kWithin) ? 1 : 0;
        }
        return yes;
    }

private:
    struct Side {
        const Model* model;
        Transform world;
    };
    Side side(const std::vector<Scene>& scenes, const Clash& clash, std::size_t i) {
        const Scene& scene = scenes[clash.model.at(i)];
        const Part& part = scene.parts[clash.part.at(i)];
        const auto [found, is_new] = models_.try_emplace({clash.model.at(i), part.mesh});
        if (is_new)
            found->second.emplace(scene.meshes[part.mesh]);
        return {&*found->second, part.world_from_mesh};
    }

    std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<Model>> models_;
    std::vector<std::pair<Side, Side>> pairs_;
};

} // namespace

void add_hard_pair_rows(const std::vector<std::string>& files, int rounds, Report& report) {
    set_threads(1);
    const std::vector<Scene> scenes = read_scenes(files);
    const ClashReport job = find_clashes(scenes, {});
    const HardPairs pairs(scenes, job);
    if (pairs.size() == 0) {
        report.notes.emplace_back("no hard pairs between the files");
        set_threads(0);
        return;
    }
    std::vector<double> narrow, bare;
    std::size_t yes = 0;
    for (int round = 0; round < rounds; ++round) {
        narrow.push_back(find_clashes(scenes, {}).seconds.narrow);
        const double begin = wall_seconds();
        yes += pairs.ask(0, pairs.size());
        bare.push_back(wall_seconds() - begin);
    }
    set_threads(0);
    const double microseconds = 1e6 / static_cast<double>(pairs.size());
    Row row{"narrow phase of files, a hard pair",
            median(narrow) * microseconds,
            "collide + within",
            median(bare) * microseconds,
            "us",
            1,
            {}};
    row.counters["hard pairs"] = static_cast<double>(pairs.size());
    row.counters["candidates"] = static_cast<double>(job.candidates);
    row.counters["bare answers yes"] = static_cast<double>(yes) / rounds;
    report.rows.push_back(row);
}

} // namespace abut::bench
