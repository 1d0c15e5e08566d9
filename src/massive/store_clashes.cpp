#include <abut/error.h>
#include <abut/store_clash.h>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/stop_watch.h"
#include "massive/clash_identity.h"
#include "massive/classify_pair.h"
#include "massive/job_record.h"
#include "massive/model_cache.h"
#include "massive/rule_match.h"
#include "massive/stored_parts.h"
#include "massive/work_units.h"
#include "math/vector.h"
#include "store/store_file.h"

#include <algorithm>
#include <future>
#include <iterator>
#include <malloc.h>
#include <map>
#include <tbb/global_control.h>
#include <unordered_map>

namespace abut {

namespace {

/// For pairs and rows of the unit at hand.
constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 10;

std::uint64_t bytes_for_models(const StoredParts& parts, const std::vector<IndexPair>& pairs,
                               const OutOfCoreOptions& options, const std::string& store) {
    const std::uint64_t tables = parts.bytes() + pairs.capacity() * sizeof(IndexPair);
    if (options.memory < kLeastMemory + tables)
        throw Error(ErrorCode::bad_argument, store,
                    "needs more memory: " + std::to_string(((kLeastMemory + tables) >> 20) + 1) +
                        " MiB at least");
    return options.memory - tables;
}

/// The plan of a job: what is to be compared, in which order.
struct Plan {
    StoredParts stored;
    std::vector<WorkUnit> units;
    std::uint64_t candidates = 0;
    std::uint64_t budget = 0;          ///< bytes of models
    std::unique_ptr<JobRecord> record; ///< may be none
};

/// What the answer depends on: the question and the parts.
Hash128 key_of(const StoredParts& stored, const ClashOptions& options) {
    Hasher hasher;
    for (const ModelRow& model : stored.models)
        hasher.add_value(model.checksum());
    hasher.add_value(question_hash(options));
    return hasher.value();
}

/// In          recorded: what the store knows of this job counts, and it is to be kept there.
Plan make_plan(StoreFile& store, const ClashOptions& options, const OutOfCoreOptions& out_of_core,
               bool recorded) {
    require_tolerances(options);
    ProgressMeter progress(options.progress, "broad phase", 3);
    Plan plan;
    plan.stored = gather_parts(store, !options.rules.empty());
    progress.advance();
    std::vector<IndexPair> pairs = find_candidates(plan.stored, options);
    plan.candidates = pairs.size();
    progress.advance();
    if (recorded && out_of_core.keep)
        plan.record =
            JobRecord::open(store.path(), {key_of(plan.stored, options), options, plan.candidates});
    if (plan.record != nullptr)
        if (auto left = plan.record->pairs_left())
            pairs = std::move(*left);
    plan.budget = bytes_for_models(plan.stored, pairs, out_of_core, store.path());
    // One unit is tested while the next one's models come into memory.
    plan.units = make_work_units(plan.stored, std::move(pairs), plan.budget / 2, out_of_core.order,
                                 store.path());
    if (plan.record != nullptr)
        plan.record->plan(plan.units);
    // What the broad phase and the partition needed is free for models, and not in small pieces.
    malloc_trim(0);
    progress.advance();
    return plan;
}

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
                next = std::async(policy, [&, u] { cache.load(u + 1); });
            test(plan_.units[u], cache, progress);
            if (next.valid())
                next.get();
            // Nothing is being read now: the store may be written to.
            record(u);
        }
        result_.counters.mesh_loads = cache.loads();
        result_.counters.bytes_read = store_.bytes_read() - read_before;
        result_.counters.peak_bytes = cache.peak_bytes();
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

    void test(const WorkUnit& unit, const ModelCache& cache, ProgressMeter& progress) {
        std::unordered_map<std::uint32_t, PartRow> rows;
        for (const IndexPair& pair : unit.pairs)
            for (const std::uint32_t part : {pair.a(), pair.b()})
                if (const auto [row, is_new] = rows.try_emplace(part); is_new)
                    row->second = store_.part(plan_.stored.parts[part].row);
        std::vector<std::optional<Clash>> found(unit.pairs.size());
        parallel_for(unit.pairs.size(), 1, [&](std::size_t k) {
            const IndexPair& pair = unit.pairs[k];
            const PartRow &a = rows.at(pair.a()), &b = rows.at(pair.b());
            const PairTerms terms = terms_of_pair(pair);
            const auto placed = [&](const PartRow& row, std::uint32_t part) {
                return ClashPart{cache.model(plan_.stored.parts[part].mesh), row.world_from_mesh,
                                 row.box};
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
    Plan plan_;
    StoreClashReport result_;
    std::map<std::uint32_t, Part> named_; ///< parts that clash
    std::vector<FoundClash> fresh_;       ///< of the piece of work at hand
    std::vector<FoundClash> clashes_;
};

Vec3 middle_of(const Box3& box) {
    return 0.5 * box.lower + 0.5 * box.upper;
}

/// Sets that are joined; how many nodes each holds.
class Components {
public:
    explicit Components(std::size_t count) : parent_(count), size_(count, 1) {
        for (std::uint32_t i = 0; i < count; ++i)
            parent_[i] = i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        if (a == b)
            return;
        if (size_[a] < size_[b])
            std::swap(a, b);
        parent_[b] = a;
        size_[a] += size_[b];
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    [[nodiscard]] std::uint32_t size(std::uint32_t root) const { return size_[root]; }

private:
    std::vector<std::uint32_t> parent_, size_;
};

} // namespace

StoreClashReport find_clashes(const Store& store, const ClashOptions& options,
                              const OutOfCoreOptions& out_of_core) {
    return StoreClashJob(store.file(), options, out_of_core).run();
}

GraphReport overlap_graph(const Store& store, const ClashOptions& options,
                          const OutOfCoreOptions& out_of_core, std::uint64_t lines) {
    StopWatch watch;
    const Plan plan = make_plan(store.file(), options, out_of_core, false);
    GraphReport report;
    report.nodes = plan.stored.parts.size();
    report.edges = plan.candidates;
    std::vector<std::uint32_t> valence(report.nodes);
    std::vector<bool> needed(plan.stored.meshes.size());
    Components components(report.nodes);
    const std::uint64_t every = lines == 0 ? 0 : std::max<std::uint64_t>(1, report.edges / lines);
    std::uint64_t edge = 0;
    for (const WorkUnit& unit : plan.units) {
        GraphReport::Unit& figures = report.units.emplace_back();
        figures.edges = unit.pairs.size();
        figures.meshes = unit.meshes.size();
        figures.bytes = unit.bytes;
        report.cut_edges += unit.cut ? unit.pairs.size() : 0;
        std::vector<std::uint32_t> parts;
        for (const IndexPair& pair : unit.pairs) {
            components.join(pair.a(), pair.b());
            if (every > 0 && edge++ % every == 0)
                report.lines.push_back({middle_of(plan.stored.parts[pair.a()].box),
                                        middle_of(plan.stored.parts[pair.b()].box),
                                        static_cast<std::uint32_t>(report.units.size() - 1)});
            for (const std::uint32_t part : {pair.a(), pair.b()}) {
                ++valence[part];
                parts.push_back(part);
            }
        }
        std::sort(parts.begin(), parts.end());
        parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
        figures.parts = parts.size();
        for (const std::uint32_t part : parts) {
            const Vec3 middle = middle_of(plan.stored.parts[part].box);
            figures.bounds.lower = min(figures.bounds.lower, middle);
            figures.bounds.upper = max(figures.bounds.upper, middle);
        }
        for (const std::uint32_t mesh : unit.meshes)
            needed[mesh] = true;
    }
    for (std::size_t i = 0; i < needed.size(); ++i)
        report.bytes += needed[i] ? plan.stored.meshes[i].bytes : 0;
    for (std::uint32_t i = 0; i < report.nodes; ++i) {
        report.highest_valence = std::max<std::uint64_t>(report.highest_valence, valence[i]);
        report.isolated += valence[i] == 0 ? 1 : 0;
        if (valence[i] > 0 && components.find(i) == i) {
            ++report.components;
            report.largest_component =
                std::max<std::uint64_t>(report.largest_component, components.size(i));
        }
    }
    if (report.nodes > report.isolated)
        report.mean_valence = 2 * static_cast<double>(report.edges) /
                              static_cast<double>(report.nodes - report.isolated);
    report.seconds = watch.lap();
    return report;
}

} // namespace abut
