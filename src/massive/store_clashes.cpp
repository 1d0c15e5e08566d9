#include <abut/error.h>
#include <abut/store_clash.h>

#include "core/progress.h"
#include "core/stop_watch.h"
#include "massive/crew/crew_clashes.h"
#include "massive/job/job_plan.h"
#include "massive/job/job_result.h"
#include "massive/work/stored_parts.h"
#include "massive/work/task_worker.h"
#include "massive/work/work_schedule.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// All work of a plan, for a job without a crew.
class AllWork final : public WorkSource {
public:
    AllWork(const JobPlan& plan, JobResult& result, const Progress& progress)
        : result_(result), schedule_(plan.stored, plan.units, 1, plan.rules.get()),
          progress_(progress, "narrow phase", plan.candidates) {
        progress_.advance(result.counters().recalled_pairs);
    }
    std::optional<Task> next() override { return schedule_.next(0); }
    void done(TaskResult result) override { result_.take({std::move(result)}); }
    void on_pair() override { progress_.advance(); }

private:
    JobResult& result_;
    WorkSchedule schedule_;
    ProgressMeter progress_;
};

void do_alone(const JobPlan& plan, JobResult& result, const ClashOptions& options,
              StoreFile& store) {
    AllWork source(plan, result, options.progress);
    TaskTester tester(store, plan.stored.models, plan.budget, plan.blocks_budget,
                      plan.hierarchies_room);
    work(tester, source);
}

/// Throws if an import has changed the store's parts since the plan was made. Results from before
/// and after an import must not be mixed.
void require_unchanged(StoreFile& store, const JobPlan& plan) {
    require_parts(store.models(), parts_key(plan.stored.models), store.path());
}

/// Returns the options that a job records. A store about whose models nothing is known, as earlier
/// versions have written it, is asked the same question as before: whether surfaces meet exactly.
ClashOptions recorded_options(StoreFile& store, const ClashOptions& options) {
    ClashOptions recorded = options;
    const auto is_unknown = [&](const ModelRow& model) {
        return store.precision(model.model) == ModelPrecision{};
    };
    if (!options.touch_tolerance && std::ranges::all_of(store.models(), is_unknown))
        recorded.touch_tolerance = 0;
    return recorded;
}

} // namespace

StoreClashReport find_clashes(const Store& store, const ClashOptions& asked,
                              const OutOfCoreOptions& out_of_core) {
    StopWatch total, watch;
    StoreFile& file = store.file();
    const ClashOptions options = recorded_options(file, asked);
    Crew* const crew = out_of_core.crew;
    JobPlan plan = make_plan(file, options, out_of_core, true);
    JobResult result(plan, options, file, crew == nullptr ? 1 : crew->size());
    result.recall();
    const double broad = watch.lap();
    try {
        if (crew == nullptr)
            do_alone(plan, result, options, file);
        else
            lead(*crew, plan, result, options, file.path());
    } catch (const Error& error) {
        // A missing part is not damage if an import removed it: report the import instead.
        if (error.code() == ErrorCode::malformed || error.code() == ErrorCode::bad_argument)
            require_unchanged(file, plan);
        throw;
    }
    require_unchanged(file, plan);
    const double narrow = watch.lap();
    StoreClashReport report = result.finish();
    if (!asked.touch_tolerance && options.touch_tolerance)
        report.report.touch_source = TouchSource::none;
    report.report.seconds.broad = broad;
    report.report.seconds.narrow = narrow;
    report.report.seconds.total = total.lap();
    report.report.peak_rss_mib = std::max(report.report.peak_rss_mib, peak_resident_mib());
    return report;
}

} // namespace abut
