#include <abut/error.h>
#include <abut/store_clash.h>

#include "core/progress.h"
#include "core/stop_watch.h"
#include "massive/clash_identity.h"
#include "massive/classify_pair.h"
#include "massive/job_plan.h"
#include "massive/large_meshes.h"
#include "massive/model_cache.h"
#include "massive/rule_match.h"
#include "store/store_file.h"

#include <algorithm>
#include <future>
#include <iterator>
#include <map>
#include <tbb/global_control.h>
#include <unordered_map>

namespace abut {

namespace {

class StoreClashJob {
public:
    StoreClashJob(StoreFile& store, const ClashOptions& options,
                  const OutOfCoreOptions& out_of_core)
        : store_(store), options_(options), out_of_core_(out_of_core) {}

    StoreClashReport run() {
        StopWatch total, watch;
        plan_ = make_plan(store_, options_, out_of_core_, true);
        summarise();
        recall();
        result_.report.seconds.broad = watch.lap();
        work();
        result_.report.seconds.narrow = watch.lap();
        finish();
        result_.report.seconds.total = total.lap();
        result_.report.peak_rss_mb = peak_resident_mib();
        return std::move(result_);
    }

private:
    void summarise() {
        ClashReport& report = result_.report;
        report.clearance = options_.clearance;
        report.touch = options_.touch;
        report.candidates = plan_.candidates;
        for (const ModelRow& model : plan_.stored.models)
            report.models.push_back({model.file, model.parts, model.triangles});
        OutOfCoreCounters& counters = result_.counters;
        counters.units = plan_.units.size();
        std::vector<bool> needed(plan_.stored.meshes.size());
        for (const WorkUnit& unit : plan_.units)
            for (const std::uint32_t mesh : unit.meshes)
                needed[mesh] = true;
        for (std::size_t i = 0; i < needed.size(); ++i)
            if (needed[i]) {
                ++counters.meshes;
                counters.bytes_needed += plan_.stored.meshes[i].stored_bytes;
            }
    }

    void work() {
        ProgressMeter progress(options_.progress, "narrow phase", plan_.candidates);
        progress.advance(result_.counters.recalled_pairs);
        ModelCache cache(store_, plan_.stored.meshes, plan_.units, plan_.budget);
        const LargeMeshes large(store_, plan_.stored, plan_.blocks_budget);
        const std::uint64_t read_before = store_.bytes_read();
        // On one thread, that thread does all.
        const auto policy =
            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1
                ? std::launch::async
                : std::launch::deferred;
        if (!plan_.units.empty())
            cache.load(0);
        for (std::size_t u = 0; u < plan_.units.size(); ++u) {
            std::future<void> next; // waits when it goes out of scope
            if (u + 1 < plan_.units.size())
                next = std::async(plan_.units[u].alone || plan_.units[u + 1].alone
                                      ? std::launch::deferred
                                      : policy,
                                  [&, u] { cache.load(u + 1); });
            test(plan_.units[u], cache, large, progress);
            if (next.valid())
                next.get();
            // Nothing is being read now: the store may be written to.
            record(u);
        }
        result_.counters.mesh_loads = cache.loads();
        result_.counters.blocks = large.cache().distinct().size();
        result_.counters.block_loads = large.cache().loads();
        result_.counters.bytes_needed += large.bytes_needed();
        result_.counters.bytes_read = store_.bytes_read() - read_before;
        result_.counters.peak_bytes = cache.peak_bytes() + large.cache().peak_bytes();
    }

    /// What was found before the job was stopped.
    void recall() {
        if (plan_.record == nullptr)
            return;
        std::uint64_t left = 0;
        for (const WorkUnit& unit : plan_.units)
            left += unit.pairs.size();
        result_.counters.kept = true;
        result_.counters.recalled_pairs = plan_.candidates - left;
        for (FoundClash& found : plan_.record->found()) {
            if (found.pair.b() >= plan_.stored.parts.size())
                throw Error(ErrorCode::malformed, store_.path(),
                            "is damaged: a clash of a job names parts that are not there");
            for (const std::uint32_t part : {found.pair.a(), found.pair.b()})
                name(part, store_.part(plan_.stored.parts[part].row));
            found.clash.model = models_of(found.pair);
            clashes_.push_back(std::move(found));
        }
    }

    void record(std::size_t unit) {
        if (plan_.record != nullptr) {
            std::vector<std::pair<std::int64_t, std::int64_t>> rows;
            for (const FoundClash& found : fresh_)
                rows.emplace_back(plan_.stored.parts[found.pair.a()].row,
                                  plan_.stored.parts[found.pair.b()].row);
            plan_.record->commit(unit, fresh_, rows);
        }
        std::move(fresh_.begin(), fresh_.end(), std::back_inserter(clashes_));
        fresh_.clear();
    }

    void name(std::uint32_t part, const PartRow& row) {
        named_.try_emplace(part, Part{row.id, row.name, row.type, 0, {}});
    }
    [[nodiscard]] std::array<std::uint32_t, 2> models_of(const IndexPair& pair) const {
        return {plan_.stored.parts[pair.a()].model, plan_.stored.parts[pair.b()].model};
    }

    void test(const WorkUnit& unit, const ModelCache& cache, const LargeMeshes& large,
              ProgressMeter& progress) {
        std::unordered_map<std::uint32_t, PartRow> rows;
        for (const IndexPair& pair : unit.pairs)
            for (const std::uint32_t part : {pair.a(), pair.b()})
                if (const auto [row, is_new] = rows.try_emplace(part); is_new)
                    row->second = store_.part(plan_.stored.parts[part].row);
        std::vector<std::optional<Clash>> found(unit.pairs.size());
        large.for_each_pair(unit.pairs, [&](std::size_t k) {
            const IndexPair& pair = unit.pairs[k];
            const PartRow &a = rows.at(pair.a()), &b = rows.at(pair.b());
            const PairTerms terms = terms_of_pair(pair);
            const auto placed = [&](const PartRow& row, std::uint32_t part) {
                const std::uint32_t mesh = plan_.stored.parts[part].mesh;
                const ModelBlocks* const blocks = large.find(mesh);
                return ClashPart{blocks == nullptr ? &cache.model(mesh) : nullptr, blocks,
                                 row.world_from_mesh, row.box};
            };
            found[k] = classify_pair(placed(a, pair.a()), placed(b, pair.b()), terms.clearance,
                                     terms.touch);
            if (found[k])
                identify(*found[k], pair, a, b, terms);
            progress.advance();
        });
        for (std::size_t k = 0; k < found.size(); ++k)
            if (found[k]) {
                const IndexPair& pair = unit.pairs[k];
                for (const std::uint32_t part : {pair.a(), pair.b()})
                    name(part, rows.at(part));
                fresh_.push_back({pair, std::move(*found[k])});
            }
    }

    [[nodiscard]] PairTerms terms_of_pair(const IndexPair& pair) const {
        if (options_.rules.empty())
            return {options_.clearance, options_.touch, nullptr};
        const StoredPart &a = plan_.stored.parts[pair.a()], &b = plan_.stored.parts[pair.b()];
        const Scene &model_a = plan_.stored.scenes[a.model],
                    &model_b = plan_.stored.scenes[b.model];
        return *terms_of(options_, model_a, model_a.parts[a.number], model_b,
                         model_b.parts[b.number]); // a candidate has terms
    }

    void identify(Clash& clash, const IndexPair& pair, const PartRow& a, const PartRow& b,
                  const PairTerms& terms) const {
        clash.model = models_of(pair);
        if (terms.rule != nullptr)
            clash.rule = terms.rule->name;
        const auto file = [&](std::size_t side) -> const std::string& {
            return plan_.stored.models[clash.model.at(side)].file;
        };
        clash.id = clash_identity(file(0), a.id, file(1), b.id, clash.kind);
    }

    /// Clashes in the order of their parts, which are known by their places among those that clash.
    void finish() {
        if (plan_.record != nullptr)
            plan_.record->finish();
        for (const ModelRow& model : plan_.stored.models)
            result_.models.emplace_back().file = model.file;
        std::unordered_map<std::uint32_t, std::uint32_t> place;
        for (auto& [part, named] : named_) {
            std::vector<Part>& parts = result_.models[plan_.stored.parts[part].model].parts;
            place.emplace(part, static_cast<std::uint32_t>(parts.size()));
            parts.push_back(std::move(named));
        }
        std::sort(clashes_.begin(), clashes_.end(),
                  [](const FoundClash& a, const FoundClash& b) { return a.pair < b.pair; });
        for (auto& [pair, clash] : clashes_) {
            clash.part = {place.at(pair.a()), place.at(pair.b())};
            ++result_.report.counts.at(static_cast<std::size_t>(clash.kind));
            result_.report.clashes.push_back(std::move(clash));
        }
    }

    StoreFile& store_;
    const ClashOptions& options_;
    const OutOfCoreOptions& out_of_core_;
    JobPlan plan_;
    StoreClashReport result_;
    std::map<std::uint32_t, Part> named_; ///< parts that clash
    std::vector<FoundClash> fresh_;       ///< of the piece of work at hand
    std::vector<FoundClash> clashes_;
};

} // namespace

StoreClashReport find_clashes(const Store& store, const ClashOptions& options,
                              const OutOfCoreOptions& out_of_core) {
    return StoreClashJob(store.file(), options, out_of_core).run();
}

} // namespace abut
