#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/frame.h>

#include "arguments/choice.h"
#include "arguments/elementary_arguments.h"
#include "arguments/frame_files.h"
#include "arguments/impact_file.h"
#include "commands.h"
#include "verbs/ccd_step.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <malloc.h>
#include <memory>
#include <utility>

namespace abut::command {

namespace {

constexpr std::array<Named<Scheme>, 6> kSchemes{{{"representative", Scheme::representative},
                                                 {"database", Scheme::database},
                                                 {"markup", Scheme::markup},
                                                 {"basic", Scheme::basic},
                                                 {"features", Scheme::features},
                                                 {"pairwise", Scheme::pairwise}}};
constexpr std::array<Named<Assignment>, 5> kAssignments{
    {{"greedy", Assignment::greedy},
     {"maximal", Assignment::maximal},
     {"uniform-vertex-edge", Assignment::uniform_vertex_edge},
     {"uniform-edge-edge", Assignment::uniform_edge_edge},
     {"adaptive", Assignment::adaptive}}};
constexpr std::array<Named<Culling>, 3> kCullings{
    {{"tree", Culling::tree}, {"grid", Culling::grid}, {"sweep", Culling::sweep}}};

/// With Assignment::adaptive, the assignment is adapted to the impacts once in this many steps,
/// because the hierarchy is rebuilt each time.
constexpr std::size_t kAdaptEvery = 8;

constexpr const char *kFailOnImpacts = "impacts", *kFailOnIntersections = "intersections";

struct CcdArguments {
    std::vector<std::string> frames;
    DeformableOptions surface;
    ElementaryArguments elementary;
    bool allow_topology_changes = false, intersections = false;
    std::string out, fail_on;

    [[nodiscard]] bool looks_at_rest() const {
        return intersections || fail_on == kFailOnIntersections;
    }
};

/// Describes how the triangles of a keyframe differ from those of the surface; empty if they are
/// the same.
std::string topology_change(const Deformable& surface, const Mesh& frame) {
    const auto &before = surface.triangles(), &after = frame.triangles;
    if (frame.positions.size() != surface.vertex_count())
        return fmt::format("{} vertices, not {}", frame.positions.size(), surface.vertex_count());
    if (after.size() != before.size())
        return fmt::format("{} triangles, not {}", after.size(), before.size());
    const auto [a, b] = std::mismatch(after.begin(), after.end(), before.begin());
    if (a == after.end())
        return "";
    return fmt::format("as triangle {} the vertices {}, {}, {}, not {}, {}, {}", a - after.begin(),
                       (*a)[0], (*a)[1], (*a)[2], (*b)[0], (*b)[1], (*b)[2]);
}

/// A sequence of keyframes: the surface that moves through them, and the options of the search for
/// impacts. Only the last two keyframes are in memory.
class Sequence {
public:
    Sequence(const CcdArguments& arguments, const std::string& first)
        : options_(arguments.elementary.options()),
          adaptive_(arguments.surface.assignment == Assignment::adaptive),
          allow_topology_changes_(arguments.allow_topology_changes),
          surface_(read_frame(first), arguments.surface) {
        if (!arguments.out.empty())
            out_ = std::make_unique<ImpactFile>(arguments.out);
    }

    [[nodiscard]] const Deformable& surface() const { return surface_; }

    /// Advances the surface from its current keyframe `from` to `to`.
    ///
    /// Errors      those of `read_frame` and ImpactFile; Error{bad_mesh} if the topology changes
    ///             and must not.
    CcdStep advance(const std::string& from, const std::string& to) {
        const Stopwatch watch;
        CcdStep step;
        step.from = from;
        step.to = to;
        auto positions = read_frame_positions(to, surface_.vertex_count(), surface_.triangles());
        step.topology_changed = !positions;
        if (positions) {
            const Stopwatch refit;
            surface_.advance(std::move(*positions));
            step.seconds_refit = refit.seconds();
            detect(step);
        } else {
            change_topology(from, to, step);
        }
        step.vertices = surface_.vertex_count();
        step.edges = surface_.edges().size();
        step.triangles = surface_.triangles().size();
        ++steps_;
        step.seconds = watch.seconds();
        return step;
    }

private:
    void change_topology(const std::string& from, const std::string& to, CcdStep& step) {
        Mesh frame = read_frame(to);
        const std::string change = topology_change(surface_, frame);
        if (change.empty()) // the file has changed since it was first read
            throw Error(ErrorCode::unreadable, to, "is being written to");
        if (!allow_topology_changes_)
            throw Error(
                ErrorCode::bad_mesh, to,
                fmt::format("has {} as {} has (see --allow-topology-changes)", change, from));
        const Stopwatch refit;
        surface_.set_mesh(std::move(frame));
        step.seconds_refit = refit.seconds();
    }

    void detect(CcdStep& step) {
        const Stopwatch watch;
        const Impacts impacts = self_impacts(surface_, options_);
        step.seconds_detect = watch.seconds();
        step.counters = impacts.counters;
        for (const FeatureImpact& impact : impacts.list) {
            ++(impact.kind == ElementaryKind::edge_edge ? step.impacts.edge_edge
                                                        : step.impacts.vertex_face);
            step.first_time = std::min(step.first_time.value_or(1), impact.time);
        }
        if (out_)
            out_->add(steps_, impacts.list);
        if (adaptive_ && steps_ % kAdaptEvery == 0) {
            const Stopwatch adapt;
            surface_.adapt(impacts);
            step.seconds_refit += adapt.seconds();
        }
    }

    ElementaryOptions options_;
    bool adaptive_, allow_topology_changes_;
    Deformable surface_;
    std::unique_ptr<ImpactFile> out_; ///< null without --out
    std::size_t steps_ = 0;
};

/// Allocations above this size are returned to the system as soon as they are freed. Otherwise a
/// sequence would keep as much more memory as its largest temporary arrays take.
constexpr int kLargeBlock = 1 << 20;

/// The steps of a sequence, and its keyframes at rest.
struct Found {
    CcdTotal total;
    std::vector<CcdStep> steps;   ///< filled for JSON output only
    std::vector<CcdFrame> frames; ///< filled for JSON output only, if asked for
    std::size_t intersections = 0;
};

nlohmann::ordered_json report_of(const CcdArguments& arguments, const Found& found, double seconds,
                                 std::size_t bytes) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (const CcdStep& step : found.steps)
        steps.push_back(describe(step));
    nlohmann::ordered_json report{
        {"scheme", name_of(arguments.surface.scheme, kSchemes)},
        {"assignment", name_of(arguments.surface.assignment, kAssignments)},
        {"culling", name_of(arguments.surface.culling, kCullings)},
        {"mode", arguments.elementary.mode},
        {"delta", arguments.elementary.options().absolute_error},
        {"thickness", arguments.elementary.thickness},
        {"steps", std::move(steps)},
        {"total", describe(found.total, seconds, bytes)}};
    for (const CcdFrame& frame : found.frames)
        report["frames"].push_back(describe(frame));
    return report;
}

int run(const CcdArguments& arguments, const CommonOptions& common) {
    const Stopwatch watch;
    mallopt(M_MMAP_THRESHOLD, kLargeBlock);
    const std::vector<std::string> frames = frame_files(arguments.frames);
    ProgressBar bar(common.progress_style());
    bar.show("steps", 0);
    Sequence sequence(arguments, frames.front());

    const bool table = !common.json && !common.quiet;
    const auto print_row = [&](const std::string& row) {
        bar.hide();
        if (table)
            print_text(row);
    };
    Found found;
    const auto look_at_rest = [&](const std::string& file) {
        if (!arguments.looks_at_rest())
            return;
        const CcdFrame frame(sequence.surface(), file);
        found.intersections += frame.all();
        print_row(table_row(frame));
        if (common.json)
            found.frames.push_back(frame);
    };
    print_row(table_head());
    look_at_rest(frames.front());
    for (std::size_t i = 1; i < frames.size(); ++i) {
        CcdStep step = sequence.advance(frames[i - 1], frames[i]);
        found.total.add(step);
        print_row(table_row(step));
        if (common.json)
            found.steps.push_back(std::move(step));
        look_at_rest(frames[i]);
        bar.show("steps", static_cast<double>(i) / static_cast<double>(frames.size() - 1));
    }
    bar.finish();
    if (table)
        print_text(table_row(found.total, watch.seconds()));
    if (common.json)
        print_json(dump(report_of(arguments, found, watch.seconds(), sequence.surface().bytes())));
    const bool problem = arguments.fail_on == kFailOnIntersections
                             ? found.intersections > 0
                             : found.total.impacts != TestCounts{} && !arguments.fail_on.empty();
    return problem ? kExitProblem : kExitDone;
}

CLI::Validator impact_file_name() {
    return CLI::Validator(
        [](std::string& name) {
            const bool good = name.ends_with(".csv") || name.ends_with(".bin");
            return good ? std::string() : fmt::format("must end in .csv or .bin, not '{}'", name);
        },
        "FILE");
}

} // namespace

Subcommand add_ccd(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<CcdArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"ccd",
         kDeforming,
         "Which features of a deforming surface meet from one frame to the next, and when",
         {{"abut ccd 'frame-*.ply' --fail-on impacts",
           "each step of a sequence; exit status 1 if anything meets"},
          {"abut ccd frame-0.ply frame-1.ply --thickness 1mm --out impacts.csv",
           "every pair that comes within a millimetre: which, when and where"}},
         "features meet (with --fail-on impacts), or a frame intersects itself (with --fail-on "
         "intersections)"});
    app->add_option("FRAME", arguments->frames,
                    "PLY or OBJ files in order, or one pattern in quotes ('frame-*.ply'), whose "
                    "matches are sorted by number")
        ->required()
        ->check(not_empty("FRAME"));
    add_choice(*app, "--scheme", arguments->surface.scheme, kSchemes,
               "How pairs of triangles become tests; it does not change the answer");
    add_choice(*app, "--assignment", arguments->surface.assignment, kAssignments,
               "Which triangle represents a vertex or an edge; it does not change the answer");
    add_choice(*app, "--culling", arguments->surface.culling, kCullings,
               "How pairs of triangles are found; it does not change the answer");
    app->add_flag("--lean", arguments->surface.lean,
                  "Keep no boxes of features: less than half of the memory, somewhat slower");
    add_elementary_arguments(*app, arguments->elementary);
    app->add_flag("--allow-topology-changes", arguments->allow_topology_changes,
                  "Restart at a frame with other triangles instead of refusing it");
    app->add_option("--out", arguments->out,
                    "Write every impact to FILE.csv or FILE.bin, step by step")
        ->check(impact_file_name());
    app->add_flag("--intersections", arguments->intersections,
                  "Also find the edges that pass through faces in each frame, at rest");
    app->add_option("--fail-on", arguments->fail_on,
                    "Exit with status 1 on 'impacts', or on 'intersections' in any frame")
        ->check(CLI::IsMember({kFailOnImpacts, kFailOnIntersections}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
