#include "massive/job/job_result.h"

#include "clash/clash_identity.h"
#include "clash/model_boxes.h"
#include "clash/report/report_order.h"
#include "math/vector.h"
#include "store/import/note_text.h"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

/// Warnings that follow from the boxes of the models.
std::vector<std::string> warn_of_boxes(const StoredParts& stored, const ClashOptions& options) {
    std::vector<std::string> files;
    files.reserve(stored.models.size());
    for (const ModelRow& model : stored.models)
        files.push_back(model.file);
    std::vector<Box3> boxes(files.size());
    for (std::size_t i = 0; i < stored.parts.size(); ++i) {
        Box3& box = boxes[stored.parts[i].model];
        box.lower = min(box.lower, stored.boxes[i].lower);
        box.upper = max(box.upper, stored.boxes[i].upper);
    }
    std::vector<std::string> warnings =
        abut::warn_of_distant_models(files, boxes, largest_clearance(options));
    for (std::string& question : ask_about_lengths(options, boxes))
        warnings.push_back(std::move(question));
    return warnings;
}

} // namespace

JobResult::JobResult(JobPlan& plan, const ClashOptions& options, StoreFile& store,
                     std::size_t workers)
    : plan_(plan), options_(options), store_(store) {
    ClashReport& report = result_.report;
    report.clearance = options.clearance;
    report.candidates = plan_.candidates;
    for (const ModelRow& model : plan_.stored.models)
        report.models.push_back({model.file, model.parts, model.triangles, model.unit, model.up,
                                 parse_notes(model.notes, store.path())});
    for (std::uint32_t m = 0; m < report.models.size(); ++m) {
        report.models[m].precision = plan_.stored.precisions[m].stated;
        report.models[m].rounding = plan_.rules->precision().rounding_of_model(m);
    }
    plan_.touch.tell(options, report);
    if (!plan_.stored.models.empty())
        report.frame = {plan_.stored.models.front().world_up, plan_.stored.models.front().file};
    report.warnings = warn_of_boxes(plan_.stored, options);
    for (std::string& warning : plan_.rules->warnings())
        report.warnings.push_back(std::move(warning));
    report.left_out = plan_.left_out;
    report.surfaces = plan_.stored.surfaces;
    OutOfCoreCounters& counters = result_.counters;
    counters.units = plan_.units.size();
    counters.workers.resize(workers);
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

void JobResult::set_known(Clash& clash) const {
    for (std::size_t side = 0; side < 2; ++side)
        clash.model[side] = plan_.stored.parts[clash.part[side]].model;
    const auto& boxes = plan_.stored.boxes;
    clash.rounding = plan_.rules->precision().rounding(clash.part[0], clash.part[1]) +
                     double_rounding(boxes[clash.part[0]], boxes[clash.part[1]]);
}

void JobResult::recall() {
    if (plan_.record == nullptr)
        return;
    std::uint64_t left = 0;
    for (const WorkUnit& unit : plan_.units)
        left += unit.pairs.size();
    result_.counters.kept = true;
    result_.counters.recalled_pairs = plan_.candidates - left;
    found_ = plan_.record->found(plan_.stored);
    for (auto& [clash, left_out] : found_) {
        set_known(clash);
        if (left_out)
            continue;
        for (const std::uint32_t part : clash.part) {
            if (named_.contains(part))
                continue;
            const PartRow row = store_.part(plan_.stored.parts[part].row);
            named_.try_emplace(part, Part{row.id, row.name, row.type, 0, {}});
        }
    }
}

void JobResult::take(std::vector<TaskResult> results) {
    const auto add_all = [&] {
        for (TaskResult& result : results)
            add(std::move(result));
    };
    if (plan_.record == nullptr)
        return add_all();
    Transaction together = plan_.record->together();
    add_all();
    together.commit();
}

void JobResult::add(TaskResult result) {
    std::unordered_map<std::int64_t, Part*> names;
    for (TaskResult::Named& named : result.named)
        names.emplace(named.row, &named.part);
    const std::size_t before = found_.size();
    for (TaskResult::Found& found : result.clashes) {
        const IndexPair pair = plan_.units[result.unit].pairs[found.pair];
        found.clash.part = {pair.a(), pair.b()};
        set_known(found.clash);
        if (!found.left_out)
            for (const std::uint32_t part : found.clash.part)
                named_.try_emplace(part, *names.at(plan_.stored.parts[part].row));
        found_.push_back({std::move(found.clash), found.left_out});
    }
    if (plan_.record != nullptr)
        plan_.record->commit(plan_.stored, result.unit,
                             std::span<const FoundClash>(found_).subspan(before),
                             result.hierarchies);
    result_.counters.hierarchies_kept += result.hierarchies.size();
    OutOfCoreCounters::Worker& figures = result_.counters.workers[result.from];
    result.worker.units = figures.units + 1;
    result.worker.pairs = figures.pairs + result.pairs;
    figures = result.worker;
}

void JobResult::sum_up_workers() {
    OutOfCoreCounters& counters = result_.counters;
    for (const OutOfCoreCounters::Worker& worker : counters.workers) {
        counters.mesh_loads += worker.mesh_loads;
        counters.blocks += worker.blocks;
        counters.block_loads += worker.block_loads;
        counters.hierarchies_found += worker.hierarchies_found;
        counters.bytes_needed += worker.block_bytes_needed;
        counters.bytes_read += worker.bytes_read;
        counters.peak_bytes = std::max(counters.peak_bytes, worker.peak_bytes);
        result_.report.peak_rss_mib = std::max(result_.report.peak_rss_mib, worker.peak_rss_mib);
    }
}

void JobResult::add_model(const ModelRow& row) {
    Scene& model = result_.models.emplace_back();
    model.file = row.file;
    model.unit = row.unit;
    model.up = row.world_up;
    model.project = row.project;
    model.map_from_project = row.map_from_project;
}

void JobResult::add_knowledge(std::span<const std::vector<std::int64_t>> rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result_.models[i].properties = store_.properties(rows[i]);
        result_.models[i].relations = store_.relations(rows[i]);
    }
}

void JobResult::move_found() {
    ClashReport& report = result_.report;
    for (auto& [clash, left_out] : found_)
        if (left_out)
            ++report.left_out.at(static_cast<std::size_t>(*left_out));
        else
            report.clashes.push_back(std::move(clash));
    found_.clear();
    std::ranges::sort(report.clashes, {}, &Clash::part);
}

StoreClashReport JobResult::finish() {
    sum_up_workers();
    move_found();
    for (const ModelRow& model : plan_.stored.models)
        add_model(model);
    for (std::size_t m = 0; m < result_.models.size(); ++m)
        result_.models[m].precision = plan_.stored.precisions[m];
    std::unordered_map<std::uint32_t, std::uint32_t> place;
    std::vector<std::vector<std::int64_t>> rows(result_.models.size());
    for (auto& [part, named] : named_) {
        rows[plan_.stored.parts[part].model].push_back(plan_.stored.parts[part].row);
        std::vector<Part>& parts = result_.models[plan_.stored.parts[part].model].parts;
        place.emplace(part, static_cast<std::uint32_t>(parts.size()));
        parts.push_back(std::move(named));
    }
    add_knowledge(rows);
    std::vector<Clash>& clashes = result_.report.clashes;
    for (Clash& clash : clashes)
        clash.part = {place.at(clash.part[0]), place.at(clash.part[1])};
    sum_up(result_.report, options_);
    RecordedJob recorded;
    if (plan_.record != nullptr) {
        plan_.record->finish(result_.report, result_.models);
        recorded = plan_.record->job();
    } else {
        store_.with_connection([&](Database& database) {
            recorded = tell_statuses(database, plan_.stored, options_, result_.report);
        });
    }
    result_.question = recorded.question;
    result_.job = recorded.job;
    return std::move(result_);
}

} // namespace abut
