#include <abut/clash.h>
#include <abut/topics.h>

#include "models/scenes.h"
#include "module.h"
#include "queries/queries.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/records.h"

namespace abut::python {

namespace {

std::uint64_t to_clash(const std::string& text) {
    const auto id = parse_clash_id(text);
    if (!id)
        throw py::value_error("'" + text + "' is no id of a clash");
    return *id;
}

std::vector<std::string> clash_texts(const Topic& topic) {
    std::vector<std::string> texts;
    for (const std::uint64_t clash : topic.clashes)
        texts.push_back(clash_id_text(clash));
    return texts;
}

void set_clashes(Topic& topic, const std::vector<std::string>& texts) {
    topic.clashes.clear();
    for (const std::string& text : texts)
        topic.clashes.push_back(to_clash(text));
}

MergeOptions to_merge_options(std::optional<std::int64_t> base, std::string author,
                              std::int64_t now) {
    return {base, std::move(author), now};
}

} // namespace

void bind_topic_records(py::module_& module) {
    py::class_<TopicComment>(module, "TopicComment", "What someone said of a topic.")
        .def(py::init([](std::string text, std::string author, std::int64_t time, std::string guid,
                         std::string viewpoint) {
                 return TopicComment{std::move(guid), std::move(author), std::move(text), time,
                                     std::move(viewpoint)};
             }),
             py::arg("text") = "", py::kw_only(), py::arg("author") = "", py::arg("time") = 0,
             py::arg("guid") = "", py::arg("viewpoint") = "")
        .def_readwrite("guid", &TopicComment::guid)
        .def_readwrite("author", &TopicComment::author)
        .def_readwrite("text", &TopicComment::text)
        .def_readwrite("time", &TopicComment::time, "seconds since 1970")
        .def_readwrite("viewpoint", &TopicComment::viewpoint, "GUID; may be empty");
    py::class_<Topic>(module, "Topic", "An issue to be settled by people.")
        .def(py::init<>())
        .def_readwrite("guid", &Topic::guid)
        .def_readwrite("title", &Topic::title)
        .def_readwrite("description", &Topic::description)
        .def_readwrite("status", &Topic::status)
        .def_readwrite("type", &Topic::type)
        .def_readwrite("priority", &Topic::priority)
        .def_readwrite("stage", &Topic::stage)
        .def_readwrite("assignee", &Topic::assignee)
        .def_readwrite("due", &Topic::due, "YYYY-MM-DD; empty: none")
        .def_readwrite("labels", &Topic::labels)
        .def_readwrite("reference_links", &Topic::reference_links)
        .def_readwrite("group", &Topic::group, "id of the group; may be empty")
        .def_property("clashes", &clash_texts, &set_clashes, "ids")
        .def_readwrite("created_by", &Topic::created_by)
        .def_readwrite("modified_by", &Topic::modified_by)
        .def_readwrite("created", &Topic::created, "seconds since 1970")
        .def_readwrite("modified", &Topic::modified, "seconds since 1970")
        .def_readwrite("comments", &Topic::comments, "list of TopicComment, by time");
    PlainBinder<TopicConflict>(module, "TopicConflict", "A field that two people have changed.")
        .field("guid", &TopicConflict::guid, "")
        .field("title", &TopicConflict::title, "")
        .field("field", &TopicConflict::field, "")
        .field("base", &TopicConflict::base, "")
        .field("stored", &TopicConflict::stored, "the value that stays")
        .field("edited", &TopicConflict::edited, "the value that is kept in a comment")
        .done();
    PlainBinder<TopicMerge>(module, "TopicMerge", "Returned by merge_topics and apply_review.")
        .field("revision", &TopicMerge::revision, "of the store after the merge")
        .field("added", &TopicMerge::added, "GUIDs")
        .field("changed", &TopicMerge::changed, "GUIDs")
        .field("comments", &TopicMerge::comments, "new ones")
        .field("marked", &TopicMerge::marked, "clashes whose mark has changed")
        .field("conflicts", &TopicMerge::conflicts, "list of TopicConflict")
        .field("warnings", &TopicMerge::warnings,
               "places of a BCF file that other programs may read differently")
        .done();
}

void bind_topics(py::module_& module) {
    module.def(
        "to_json", [](const TopicMerge& merge) { return to_json(merge); }, py::arg("merge"));
    module.def("group_topic_guid", &group_topic_guid, py::arg("group"),
               "The GUID of the topic of a group, by its id.");
    module.def(
        "clash_topic_guid",
        [](const std::string& clash) { return clash_topic_guid(to_clash(clash)); },
        py::arg("clash"), "The GUID of the topic of a clash, by its id.");
    module.def(
        "topics_of_groups", [](const Report& report) { return topics_of_groups(report.report); },
        py::arg("report"), "One Topic for each innermost group of a report; then the others.");
    module.def(
        "read_topics", [](const OpenStore& store) { return read_topics(store.get()); },
        py::arg("store"), "The topics of a store. Raises Error (malformed).");
    module.def(
        "untouched_topics", [](const OpenStore& store) { return untouched_topics(store.get()); },
        py::arg("store"),
        "The topics of a store's groups and clashes, also of resolved ones, before anybody says "
        "anything about them.");
    module.def(
        "topics_revision", [](const OpenStore& store) { return topics_revision(store.get()); },
        py::arg("store"), "The number of the last change of topics.");
    module.def(
        "merge_topics",
        [](const OpenStore& store, const std::vector<Topic>& edited,
           std::optional<std::int64_t> base, std::string author, std::int64_t now) {
            return merge_topics(store.get(), edited,
                                to_merge_options(base, std::move(author), now));
        },
        py::arg("store"), py::arg("edited"), py::kw_only(), py::arg("base") = py::none(),
        py::arg("author") = "", py::arg("now") = 0,
        "Merges edited topics into a store that was opened with read_only=False.\n\n"
        "edited  list of Topic\n"
        "base    the revision that they were made from; None: the last one\n"
        "author  who made the changes\n"
        "now     seconds since 1970; 0: the clock\n\n"
        "Returns a TopicMerge. Raises Error: bad_argument, cannot_write.");
    module.def(
        "apply_review",
        [](const OpenStore& store, const py::object& path, std::optional<std::int64_t> base,
           std::string author, std::int64_t now) {
            return apply_review(store.get(), to_path(path),
                                to_merge_options(base, std::move(author), now));
        },
        py::arg("store"), py::arg("path"), py::kw_only(), py::arg("base") = py::none(),
        py::arg("author") = "", py::arg("now") = 0,
        "Merges a file of edits, as the report page saves it. Otherwise as merge_topics.");
}

} // namespace abut::python
