#include <abut/store_clash.h>

#include "core/progress.h"
#include "core/stop_watch.h"
#include "massive/job_plan.h"
#include "massive/job_result.h"
#include "massive/piece_worker.h"
#include "massive/work_schedule.h"
#include "store/store_file.h"

#include <utility>

namespace abut {

namespace {

/// All the work of a plan, for one worker.
class AllWork final : public WorkSource {
public:
    AllWork(const JobPlan& plan, JobResult& result, const Progress& progress)
        : plan_(plan), result_(result), schedule_(plan.units, plan.stored.meshes.size(), 1),
          progress_(progress, "narrow phase", plan.candidates) {
        progress_.advance(result.counters().recalled_pairs);
    }
    std::optional<WorkPiece> next() override {
        const auto unit = schedule_.next(0);
        if (!unit)
            return std::nullopt;
        WorkPiece piece = make_piece(plan_.stored, plan_.units, *unit);
        for (std::size_t i = 0; i < piece.meshes.size(); ++i)
            piece.meshes[i].next_use = schedule_.next_use(0, plan_.units[*unit].meshes[i], *unit);
        return piece;
    }
    void done(PieceResult result) override { result_.take(std::move(result)); }
    void on_pair() override { progress_.advance(); }

private:
    const JobPlan& plan_;
    JobResult& result_;
    WorkSchedule schedule_;
    ProgressMeter progress_;
};

} // namespace

StoreClashReport find_clashes(const Store& store, const ClashOptions& options,
                              const OutOfCoreOptions& out_of_core) {
    StopWatch total, watch;
    StoreFile& file = store.file();
    JobPlan plan = make_plan(file, options, out_of_core, true);
    JobResult result(plan, options, file);
    result.recall();
    const double broad = watch.lap();
    AllWork source(plan, result, options.progress);
    PieceTester tester(file, options, plan.stored.models, plan.budget);
    work(tester, source);
    const double narrow = watch.lap();
    StoreClashReport report = result.finish();
    report.report.seconds.broad = broad;
    report.report.seconds.narrow = narrow;
    report.report.seconds.total = total.lap();
    report.report.peak_rss_mb = peak_resident_mib();
    return report;
}

} // namespace abut
