#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/error.h>
#include <abut/progress.h>

#include "clash/clash_identity.h"
#include "clash/mesh_in_blocks.h"
#include "clash/model_boxes.h"
#include "clash/part_instances.h"
#include "clash/report/report_order.h"
#include "clash/rules/rule_table.h"
#include "clash/surface_parts.h"
#include "clash/test_pair.h"
#include "clash/touch_of_report.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/stop_watch.h"
#include "math/vector.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace abut {

namespace {

struct Candidate {
    std::uint32_t a, b; ///< indices in PartInstances::parts
    PairTerms terms;
    double rounding = 0; ///< as Clash::rounding
};

class ClashJob {
public:
    ClashJob(const std::vector<Scene>& models, const ClashOptions& options)
        : models_(models), options_(options) {}

    ClashReport run() {
        StopWatch total, watch;
        summarise();
        find_candidates();
        report_.seconds.broad = watch.lap();
        build();
        report_.seconds.build = watch.lap();
        classify();
        report_.seconds.narrow = watch.lap();
        report_.seconds.total = total.lap();
        report_.peak_rss_mib = peak_resident_mib();
        return std::move(report_);
    }

private:
    void summarise() {
        report_.clearance = options_.clearance;
        if (!models_.empty())
            report_.frame = {models_.front().up, models_.front().file};
        for (const Scene& model : models_) {
            ClashReport::ModelSummary summary{
                model.file,  model.parts.size(),    0, model.unit, model.up,
                model.notes, model.precision.stated};
            for (const Part& part : model.parts)
                summary.triangles +=
                    part.mesh < model.meshes.size() ? model.meshes[part.mesh].triangles.size() : 0;
            report_.models.push_back(summary);
        }
    }

    [[nodiscard]] const Part& part(std::uint32_t i) const {
        return models_[parts_.parts[i].model].parts[parts_.parts[i].part];
    }

    void find_candidates() {
        ProgressMeter progress(options_.progress, "broad phase", 2);
        parts_ = gather_parts(models_);
        progress.advance();
        std::vector<Box3> boxes;
        boxes.reserve(parts_.parts.size());
        warn(boxes_of_models());
        RuleTable rules(options_);
        for (std::uint32_t i = 0; i < parts_.parts.size(); ++i) {
            const PartInstance& p = parts_.parts[i];
            boxes.push_back(p.box);
            rules.add({p.model, models_[p.model].file, part(i).id, part(i).name, part(i).type,
                       &models_[p.model].properties, p.part});
            rules.add_precision(p.model, models_[p.model].precision.stated, p.rounding);
        }
        std::size_t first = 0;
        for (const Scene& model : models_) {
            rules.add(model.relations, first);
            first += model.parts.size();
        }
        rules.require_known([&] {
            std::vector<std::string> names;
            for (const Scene& model : models_)
                names.insert(names.end(), model.properties.names.begin(),
                             model.properties.names.end());
            return names;
        });
        for (std::string& warning : rules.warnings())
            report_.warnings.push_back(std::move(warning));
        const bool across = models_.size() > 1 && !options_.self;
        const auto filter = [&](std::uint32_t i, std::uint32_t j) {
            return !across || parts_.parts[i].model != parts_.parts[j].model;
        };
        TouchOfReport touch;
        for (const IndexPair pair : overlapping_boxes(boxes, rules.largest_reach(boxes), filter)) {
            const std::uint32_t i = pair.a(), j = pair.b();
            const PairDecision decision = rules.decide(i, j);
            if (!decision.reach.holds(boxes[i], boxes[j]))
                continue;
            if (!decision.terms) {
                ++report_.left_out.at(static_cast<std::size_t>(decision.reason));
                continue;
            }
            touch.add(rules.precision(), i, j);
            candidates_.push_back(
                {i, j, *decision.terms,
                 rules.precision().rounding(i, j) + double_rounding(boxes[i], boxes[j])});
        }
        touch.tell(options_, report_);
        for (std::uint32_t m = 0; m < models_.size(); ++m)
            report_.models[m].rounding = rules.precision().rounding_of_model(m);
        report_.candidates = candidates_.size();
        progress.advance();
    }

    [[nodiscard]] std::vector<Box3> boxes_of_models() const {
        std::vector<Box3> boxes(models_.size());
        for (const PartInstance& part : parts_.parts) {
            Box3& box = boxes[part.model];
            box.lower = min(box.lower, part.box.lower);
            box.upper = max(box.upper, part.box.upper);
        }
        return boxes;
    }

    void warn(const std::vector<Box3>& boxes) {
        std::vector<std::string> files;
        files.reserve(models_.size());
        for (const Scene& model : models_)
            files.push_back(model.file);
        report_.warnings = warn_of_distant_models(files, boxes, largest_clearance(options_));
        for (std::string& question : ask_about_lengths(options_, boxes))
            report_.warnings.push_back(std::move(question));
    }

    void build() {
        report_.surfaces = surface_parts(models_, parts_);
        std::vector<bool> needed(parts_.meshes.size());
        for (const Candidate& c : candidates_)
            needed[parts_.parts[c.a].mesh] = needed[parts_.parts[c.b].mesh] = true;
        std::vector<std::uint32_t> list;
        for (std::uint32_t i = 0; i < needed.size(); ++i)
            if (needed[i])
                list.push_back(i);
        ProgressMeter progress(options_.progress, "hierarchies", list.size());
        meshes_.resize(parts_.meshes.size());
        blocks_.resize(parts_.meshes.size());
        parallel_for(list.size(), 1, [&](std::size_t k) {
            const Mesh& mesh = *parts_.meshes[list[k]];
            // Cut into blocks exactly where the out-of-core job does, so that both give the same
            // result.
            if (is_whole(mesh.positions.size(), mesh.triangles.size()))
                meshes_[list[k]].emplace(mesh);
            else
                blocks_[list[k]] = in_blocks(mesh);
            progress.advance();
        });
    }

    void classify() {
        ProgressMeter progress(options_.progress, "narrow phase", candidates_.size());
        std::vector<PairAnswer> found(candidates_.size());
        parallel_for(candidates_.size(), 1, [&](std::size_t k) {
            const Candidate& c = candidates_[k];
            found[k] =
                test_pair(narrow_part(c.a), part(c.a).id, narrow_part(c.b), part(c.b).id, c.terms);
            if (found[k].clash)
                identify(*found[k].clash, c);
            progress.advance();
        });
        // Candidates are sorted by part, so the clashes are too.
        for (PairAnswer& answer : found) {
            if (answer.left_out)
                ++report_.left_out.at(static_cast<std::size_t>(*answer.left_out));
            else if (answer.clash)
                report_.clashes.push_back(std::move(*answer.clash));
        }
        sum_up(report_, options_);
    }

    [[nodiscard]] ClashPart narrow_part(std::uint32_t i) const {
        const PartInstance& p = parts_.parts[i];
        const std::optional<Model>& model = meshes_[p.mesh];
        return {model ? &*model : nullptr, blocks_[p.mesh].get(), p.world_from_mesh, p.box};
    }

    void identify(Clash& clash, const Candidate& c) const {
        const PartInstance &a = parts_.parts[c.a], &b = parts_.parts[c.b];
        clash.model = {a.model, b.model};
        clash.part = {a.part, b.part};
        clash.rounding = c.rounding;
        if (c.terms.rule != nullptr)
            clash.rule = c.terms.rule->name, clash.severity = c.terms.rule->severity;
        clash.id = clash_identity(models_[a.model].file, part(c.a).id, models_[b.model].file,
                                  part(c.b).id, clash.kind);
    }

    const std::vector<Scene>& models_;
    const ClashOptions& options_;
    ClashReport report_;
    PartInstances parts_;
    std::vector<Candidate> candidates_;
    std::vector<std::optional<Model>> meshes_;               ///< by mesh, if a candidate needs it
    std::vector<std::unique_ptr<const ModelBlocks>> blocks_; ///< for large meshes
};

} // namespace

ClashReport find_clashes(const std::vector<Scene>& models, const ClashOptions& options) {
    require_tolerances(options);
    const StopScope stopping(options.progress);
    return ClashJob(models, options).run();
}

} // namespace abut
