#include <abut/clash_groups.h>
#include <abut/clash_review.h>

#include "module.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

template <typename Key, std::size_t count>
py::dict dict_of(const std::array<std::uint64_t, count>& numbers,
                 const std::array<Key, count>& keys) {
    py::dict dict;
    for (const Key key : keys)
        dict[to_string(key)] = numbers[static_cast<std::size_t>(key)];
    return dict;
}

std::vector<GroupBy> to_criteria(const py::object& by) {
    if (py::isinstance<py::str>(by))
        return parse_grouping(by.cast<std::string>());
    return by.cast<std::vector<GroupBy>>();
}

void run_group_clashes(Report& report, const py::object& store, const py::object& by,
                       std::uint32_t least, double reach, const py::object& progress) {
    GroupOptions options;
    if (!by.is_none())
        options.by = to_criteria(by);
    options.least = least;
    options.reach = reach;
    Work work(progress);
    if (store.is_none()) {
        report.report.groups = work.run([&](const Progress& reported) {
            options.progress = reported;
            return group_clashes(report.report, *report.models, options);
        });
        report.report.grouping = options.by;
        return;
    }
    const Store open = store.cast<const OpenStore&>().get();
    StoreClashReport found{report.report, *report.models, {}, report.question, report.job};
    work.run([&](const Progress& reported) {
        options.progress = reported;
        group_clashes(open, found, options);
        return true;
    });
    report.report = std::move(found.report);
}

void bind_group_review(py::module_& module) {
    PlainBinder<ListedGroup>(module, "ListedGroup", "A group as a store lists it.")
        .field("id", &ListedGroup::id, "")
        .field("path", &ListedGroup::path, "names of the groups around it")
        .field("name", &ListedGroup::name, "")
        .field("what", &ListedGroup::what, "")
        .field("kind", &ListedGroup::kind, "GroupKind")
        .field("change", &ListedGroup::change, "GroupChange")
        .field("size", &ListedGroup::size, "clashes that it has now")
        .field("centre", &ListedGroup::centre, "")
        .field("appeared", &ListedGroup::appeared, "seconds since 1970; 0: never")
        .field("reopened", &ListedGroup::reopened, "seconds since 1970; 0: never")
        .field("moved", &ListedGroup::moved, "seconds since 1970; 0: never")
        .field("resolved", &ListedGroup::resolved, "seconds since 1970; 0: never")
        .field("topic", &ListedGroup::topic, "Topic; None if nobody has said anything")
        .done();
    PlainBinder<GroupReview>(module, "GroupReview",
                             "The groups of one question by one grouping, and their changes.")
        .field("clearance", &GroupReview::clearance, "metres")
        .field("touch_tolerance", &GroupReview::touch_tolerance,
               "metres; None: what the files tell apart")
        .field("self", &GroupReview::self, "")
        .field("rules", &GroupReview::rules, "how many")
        .field("by", &GroupReview::by, "list of GroupBy")
        .field("since", &GroupReview::since, "end of the job that changes are counted from")
        .field("finished", &GroupReview::finished, "end of the last job")
        .property(
            "changes", [](const GroupReview& self) { return dict_of(self.changes, kGroupChanges); },
            "dict of change to number")
        .field("groups", &GroupReview::groups, "list of ListedGroup")
        .field("history", &GroupReview::history, "list of JobCounts, the earliest first")
        .done();
    module.def(
        "to_json", [](const GroupReview& review) { return to_json(review); }, py::arg("review"));
    module.def(
        "review_groups",
        [](const OpenStore& store, std::optional<std::int64_t> since) {
            return review_groups(store.get(), since);
        },
        py::arg("store"), py::arg("since") = py::none(),
        "One GroupReview for each question and grouping of a store: what has become of the groups "
        "since the last job that\n"
        "ended before a time (seconds since 1970); None: since the job before the last one.");
}

} // namespace

/// Before what uses them.
void bind_group_records(py::module_& module) {
    bind_enum<GroupBy>(module, "GroupBy",
                       {"part", "place", "storey", "system", "types", "discipline"},
                       "A criterion by which clashes are grouped.");
    bind_enum<GroupKind>(module, "GroupKind",
                         {"part", "copies", "place", "storey", "system", "types", "discipline"},
                         "What the clashes of a group share.");
    bind_enum<GroupChange>(module, "GroupChange",
                           {"fresh", "active", "moved", "reopened", "resolved"},
                           "What has become of a group between two jobs of a store.");
    PlainBinder<ClashGroup>(module, "ClashGroup", "Clashes that share a property.")
        .field("id", &ClashGroup::id, "16 hexadecimal digits, the same in every run")
        .field("name", &ClashGroup::name, "")
        .field("what", &ClashGroup::what, "the types that clash, with their numbers")
        .field("kind", &ClashGroup::kind, "GroupKind")
        .field("key", &ClashGroup::key, "what all clashes share")
        .field("clashes", &ClashGroup::clashes, "indices in the report's clashes")
        .field("groups", &ClashGroup::groups, "list of ClashGroup, those of the next criterion")
        .field("bounds", &ClashGroup::bounds, "Box3 of the witness points")
        .field("centre", &ClashGroup::centre, "")
        .property(
            "counts", [](const ClashGroup& self) { return dict_of(self.counts, kClashKinds); },
            "dict of kind to number")
        .field("deepest", &ClashGroup::deepest, "the smallest distance, metres")
        .field("part", &ClashGroup::part, "model and part that all clashes share; else None")
        .field("change", &ClashGroup::change, "GroupChange, of a store; else None")
        .done();
    PlainBinder<JobCounts>(module, "JobCounts", "The numbers of one job of a store.")
        .field("finished", &JobCounts::finished, "seconds since 1970")
        .property(
            "kinds", [](const JobCounts& self) { return dict_of(self.kinds, kClashKinds); },
            "dict of kind to number")
        .property(
            "statuses",
            [](const JobCounts& self) { return dict_of(self.statuses, kClashStatuses); },
            "dict of status to number")
        .property(
            "groups", [](const JobCounts& self) { return dict_of(self.groups, kGroupChanges); },
            "dict of change to number")
        .done();
}

void bind_clash_groups(py::module_& module) {
    bind_group_review(module);
    module.def("group_clashes", &run_group_clashes, py::arg("report"), py::kw_only(),
               py::arg("store") = py::none(), py::arg("by") = py::none(),
               py::arg("least") = GroupOptions().least, py::arg("reach") = GroupOptions().reach,
               py::arg("progress") = py::none(),
               "Groups the clashes of a report: sets report.groups.\n\n"
               "store     the store of the report: clashes stay in their earlier groups, which "
               "keep their ids and names\n"
               "by        criteria, outermost first: 'storey,part', or a list of GroupBy; default "
               "'part,place'\n"
               "least     clashes that must share a part to be a group of it\n"
               "reach     metres; the largest distance of a clash from the centre of its place\n"
               "progress  function of (stage, fraction)\n\n"
               "Raises Error (bad_argument), those of the store.");
    module.def("parse_grouping", &parse_grouping, py::arg("text"),
               "Criteria of a text such as 'storey,part': a list of GroupBy.");
    module.def(
        "innermost_groups",
        [](const std::vector<ClashGroup>& groups) {
            std::vector<ClashGroup> found;
            for (const ClashGroup* group : innermost_groups(groups))
                found.push_back(*group);
            return found;
        },
        py::arg("groups"), "The groups that hold no other group: a list of ClashGroup.");
    module.def(
        "groups_of_clashes",
        [](const Report& report) {
            std::vector<std::optional<std::string>> ids;
            for (const ClashGroup* group : groups_of_clashes(report.report))
                ids.push_back(group == nullptr ? std::nullopt : std::optional(group->id));
            return ids;
        },
        py::arg("report"), "The id of the innermost group of each clash; None: not grouped.");
}

} // namespace abut::python
