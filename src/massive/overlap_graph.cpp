#include <abut/store_clash.h>

#include "core/disjoint_sets.h"
#include "core/stop_watch.h"
#include "massive/job/job_plan.h"
#include "massive/record/graph_rows.h"
#include "math/vector.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace abut {

namespace {

Vec3 middle_of(const Box3& box) {
    return 0.5 * box.lower + 0.5 * box.upper;
}

/// Sums up the figures of a graph report. add() is called for each work unit in order.
class GraphFigures {
public:
    GraphFigures(const JobPlan& plan, std::uint64_t lines)
        : plan_(plan), valence_(plan.stored.parts.size()), needed_(plan.stored.meshes.size()),
          components_(plan.stored.parts.size()),
          every_(lines == 0 ? 0 : std::max<std::uint64_t>(1, plan.candidates / lines)) {
        report_.nodes = plan.stored.parts.size();
        report_.edges = plan.candidates;
    }

    void add(const WorkUnit& unit) {
        std::vector<std::uint32_t> parts;
        for (const IndexPair& pair : unit.pairs) {
            add_edge(pair);
            for (const std::uint32_t part : {pair.a(), pair.b()})
                needed_[plan_.stored.parts[part].mesh] = true;
            parts.insert(parts.end(), {pair.a(), pair.b()});
        }
        std::sort(parts.begin(), parts.end());
        parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
        report_.cut_edges += unit.cut ? unit.pairs.size() : 0;
        GraphReport::Unit& figures = report_.units.emplace_back();
        figures.parts = parts.size();
        figures.edges = unit.pairs.size();
        figures.meshes = unit.meshes.size();
        figures.bytes = unit.bytes;
        for (const std::uint32_t part : parts) {
            figures.bounds.lower = min(figures.bounds.lower, middle(part));
            figures.bounds.upper = max(figures.bounds.upper, middle(part));
            figures.middle =
                figures.middle + (1 / static_cast<double>(parts.size())) * middle(part);
        }
    }

    GraphReport finish() {
        for (std::uint32_t i = 0; i < needed_.size(); ++i) {
            if (!needed_[i])
                continue;
            const StoredLargeMesh* const large = plan_.stored.find_large(i);
            report_.bytes += large != nullptr ? large->bytes : plan_.stored.meshes[i].bytes;
            report_.large_meshes += large != nullptr ? 1 : 0;
            report_.large_bytes += large != nullptr ? large->bytes : 0;
        }
        std::vector<std::uint32_t> parts_of(report_.nodes); // by the root of a component
        for (std::uint32_t i = 0; i < report_.nodes; ++i)
            ++parts_of[components_.root(i)];
        for (std::uint32_t i = 0; i < report_.nodes; ++i) {
            report_.highest_valence = std::max<std::uint64_t>(report_.highest_valence, valence_[i]);
            report_.isolated += valence_[i] == 0 ? 1 : 0;
            if (valence_[i] == 0 || components_.root(i) != i)
                continue;
            ++report_.components;
            report_.largest_component =
                std::max<std::uint64_t>(report_.largest_component, parts_of[i]);
        }
        if (report_.nodes > report_.isolated)
            report_.mean_valence = 2 * static_cast<double>(report_.edges) /
                                   static_cast<double>(report_.nodes - report_.isolated);
        return std::move(report_);
    }

private:
    [[nodiscard]] Vec3 middle(std::uint32_t part) const {
        return middle_of(plan_.stored.boxes[part]);
    }

    void add_edge(const IndexPair& pair) {
        components_.unite(pair.a(), pair.b());
        ++valence_[pair.a()], ++valence_[pair.b()];
        if (every_ > 0 && edges_++ % every_ == 0)
            report_.lines.push_back({middle(pair.a()), middle(pair.b()),
                                     static_cast<std::uint32_t>(report_.units.size())});
    }

    const JobPlan& plan_;
    GraphReport report_;
    std::vector<std::uint32_t> valence_; ///< by part
    std::vector<bool> needed_;           ///< by mesh: whether an edge needs it
    DisjointSets components_;            ///< parts that a path of edges connects
    std::uint64_t every_, edges_ = 0;
};

} // namespace

GraphReport overlap_graph(const Store& store, const ClashOptions& options,
                          const OutOfCoreOptions& out_of_core, std::uint64_t lines, bool keep) {
    StopWatch watch;
    const JobPlan plan = make_plan(store.file(), options, out_of_core, false);
    GraphFigures figures(plan, lines);
    for (const WorkUnit& unit : plan.units)
        figures.add(unit);
    GraphReport report = figures.finish();
    if (keep) {
        Database database(store.file().path(), OpenMode::read_write);
        database.run("PRAGMA busy_timeout = 10000; PRAGMA synchronous = FULL");
        Transaction transaction(database);
        keep_graph(database, options.clearance, plan.stored, plan.units);
        transaction.commit();
    }
    report.seconds = watch.lap();
    return report;
}

} // namespace abut
