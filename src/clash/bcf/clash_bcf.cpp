#include <abut/clash_bcf.h>
#include <abut/clash_groups.h>

#include "bcf/bcf_parts.h"
#include "clash/bcf/topic_fields.h"
#include "clash/bcf/topic_viewpoint.h"
#include "clash/groups/group_topics.h"
#include "clash/report/clash_text.h"
#include "core/stop.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <set>
#include <sys/stat.h>
#include <unordered_map>

namespace abut {

namespace {

using ClashLists = std::vector<std::vector<std::uint32_t>>;
using MakeViewpoints = std::function<std::vector<ClashViewpoint>(const ClashLists&)>;

/// The time of the last change of a file; empty if there is no such file.
std::string time_of_file(const std::string& path) {
    struct stat state {};
    return stat(path.c_str(), &state) == 0 ? bcf_time(state.st_mtime) : "";
}

/// Makes the topics of one report.
class TopicMaker {
public:
    TopicMaker(const ClashReport& report, const std::vector<Scene>& models,
               const ClashBcfOptions& options)
        : report_(report), models_(models), options_(options),
          time_(options.time != 0 ? options.time : std::time(nullptr)) {
        for (std::uint32_t i = 0; i < report.clashes.size(); ++i)
            indices_[report.clashes[i].id].push_back(i);
        for (const Scene& scene : models)
            files_.push_back({scene.project,
                              "",
                              true,
                              std::filesystem::path(scene.file).filename().string(),
                              time_of_file(scene.file),
                              scene.file,
                              {}});
    }

    /// In          revision: of the store's topics; none: the report is not that of a store.
    BcfFile make(const MakeViewpoints& make_viewpoints,
                 std::optional<std::int64_t> revision = std::nullopt) {
        const std::vector<Topic> topics =
            report_.groups.empty() ? topics_of_clashes() : topics_of_groups(report_);
        ClashLists lists;
        for (const Topic& topic : topics)
            lists.push_back(clashes_of(topic));
        const std::vector<ClashViewpoint> views = make_viewpoints(lists);
        BcfFile file;
        for (std::size_t i = 0; i < topics.size(); ++i) {
            poll_stop();
            file.topics.push_back(topic_of(topics[i], lists[i], views[i]));
        }
        std::ranges::sort(file.topics, {}, &BcfTopic::folder);
        if (!options_.project.empty()) {
            file.project_name = options_.project;
            file.project_id = missing_guid("project " + options_.project);
        }
        if (revision)
            file.entries.push_back(
                {kRevisionEntry, kRevisionWord + std::to_string(*revision) + "\n"});
        state_words(file);
        return file;
    }

private:
    [[nodiscard]] std::vector<Topic> topics_of_clashes() const {
        std::unordered_map<std::string, const Topic*> known;
        for (const Topic& topic : report_.topics)
            known.emplace(topic.guid, &topic);
        std::vector<Topic> topics;
        std::set<std::string> made;
        for (const Clash& clash : report_.clashes) {
            Topic topic = fresh_topic_of(clash);
            if (!made.insert(topic.guid).second)
                continue;
            if (const auto found = known.find(topic.guid); found != known.end())
                topic = *found->second;
            topics.push_back(std::move(topic));
        }
        for (const Topic& topic : report_.topics)
            if (!made.contains(topic.guid))
                topics.push_back(topic);
        return topics;
    }

    [[nodiscard]] Topic fresh_topic_of(const Clash& clash) const {
        const auto name = [&](std::size_t side) {
            const Part& part = models_.at(clash.model.at(side)).parts.at(clash.part.at(side));
            return part.name.empty() ? part.id : part.name;
        };
        return fresh_topic_of_clash(clash.id, name(0), name(1));
    }

    [[nodiscard]] std::vector<std::uint32_t> clashes_of(const Topic& topic) const {
        std::vector<std::uint32_t> list;
        for (const std::uint64_t id : topic.clashes)
            if (const auto found = indices_.find(id); found != indices_.end())
                list.insert(list.end(), found->second.begin(), found->second.end());
        std::ranges::sort(list);
        return list;
    }

    [[nodiscard]] BcfTopic topic_of(const Topic& topic, const std::vector<std::uint32_t>& clashes,
                                    const ClashViewpoint& view) const {
        BcfTopic result = bcf_topic(topic, options_.author, time_);
        if (clashes.empty()) {
            result.description = topic.description;
            return result;
        }
        describe(result, topic, clashes);
        std::set<std::uint32_t> models;
        for (const std::uint32_t index : clashes)
            models.insert(report_.clashes[index].model.begin(), report_.clashes[index].model.end());
        for (const std::uint32_t model : models)
            result.files.push_back(files_.at(model));
        BcfViewpoint viewpoint =
            topic_viewpoint(view, report_.frame.up, models_, result.guid, options_.clip);
        if (options_.snapshot)
            viewpoint.snapshot = options_.snapshot(view);
        if (!viewpoint.snapshot.empty())
            viewpoint.snapshot_file = "snapshot.png";
        result.viewpoints.push_back(std::move(viewpoint));
        return result;
    }

    struct DerivedWords {
        std::string line;
        std::vector<std::string> labels;
    };

    /// Adds the words that follow from the clashes. An import takes them away again.
    void describe(BcfTopic& result, const Topic& topic,
                  const std::vector<std::uint32_t>& clashes) const {
        DerivedWords words = derived_words(clashes);
        result.labels.insert(result.labels.end(), words.labels.begin(), words.labels.end());
        if (topic.created == 0 && !topic.description.empty())
            words.line += "; " + topic.description;
        if (result.priority.empty())
            for (const std::uint32_t index : clashes)
                if (result.priority.empty())
                    result.priority = report_.clashes[index].severity;
        if (topic.priority.empty() && !result.priority.empty())
            words.line += std::string(kDerivedPriority) + result.priority;
        result.description += (result.description.empty() ? "" : "\n") + words.line;
    }

    [[nodiscard]] DerivedWords derived_words(const std::vector<std::uint32_t>& clashes) const {
        std::array<std::uint64_t, kClashKinds.size()> counts{};
        std::set<std::string> labels;
        double deepest = 0;
        for (const std::uint32_t index : clashes) {
            const Clash& clash = report_.clashes[index];
            ++counts.at(static_cast<std::size_t>(clash.kind));
            deepest = std::min(deepest, told_distance(clash));
            labels.insert(std::string("kind: ") + abut::to_string(clash.kind));
            for (std::size_t side = 0; side < 2; ++side)
                for (const char* const name : {"storey", "discipline"})
                    if (const std::string_view value =
                            models_.at(clash.model.at(side))
                                .properties.value(clash.part.at(side), name);
                        !value.empty())
                        labels.insert(name + std::string(": ") + std::string(value));
        }
        std::string words(kDerivedLine);
        const char* comma = "";
        for (const ClashKind kind : kClashKinds)
            if (const std::uint64_t count = counts.at(static_cast<std::size_t>(kind)); count > 0) {
                words += fmt::format("{}{} {}", comma, count, abut::to_string(kind));
                comma = ", ";
            }
        if (deepest < 0)
            words += -deepest < 0.0005 // else it would read as no depth
                         ? fmt::format("; at most {:.2g} mm deep", -1000 * deepest)
                         : fmt::format("; at most {:.3f} m deep", -deepest);
        return {std::move(words), {labels.begin(), labels.end()}};
    }

    /// BCF wants a list of all words that topics use.
    static void state_words(BcfFile& file) {
        std::set<std::string> types, priorities, labels, users, stages;
        std::set<std::string> statuses{"Open", "Assigned", "Resolved", "Closed", "Approved"};
        const auto add = [](std::set<std::string>& set, const std::string& word) {
            if (!word.empty())
                set.insert(word);
        };
        for (const BcfTopic& topic : file.topics) {
            add(types, topic.type);
            add(statuses, topic.status);
            add(priorities, topic.priority);
            add(stages, topic.stage);
            add(users, topic.assigned_to);
            add(users, topic.creation_author);
            add(users, topic.modified_author);
            labels.insert(topic.labels.begin(), topic.labels.end());
            for (const BcfComment& comment : topic.comments)
                add(users, comment.author);
        }
        const auto list = [](const std::set<std::string>& set) {
            return std::vector<std::string>(set.begin(), set.end());
        };
        file.extensions = {list(types), list(statuses), list(priorities), list(labels), list(users),
                           {},          list(stages)};
    }

    const ClashReport& report_;
    const std::vector<Scene>& models_;
    const ClashBcfOptions& options_;
    std::int64_t time_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> indices_; ///< by clash id
    std::vector<BcfHeaderFile> files_;                                      ///< by model
};

ViewpointOptions viewpoint_options(const ClashBcfOptions& options) {
    ViewpointOptions viewpoint;
    viewpoint.near = true;
    viewpoint.progress = options.progress;
    return viewpoint;
}

} // namespace

BcfFile clash_bcf(const ClashReport& report, const std::vector<Scene>& models,
                  const ClashBcfOptions& options) {
    const StopScope stop(options.progress);
    return TopicMaker(report, models, options).make([&](const ClashLists& lists) {
        return clash_viewpoints(report, models, lists, viewpoint_options(options));
    });
}

BcfFile clash_bcf(const StoreClashReport& found, const Store& store,
                  const ClashBcfOptions& options) {
    const StopScope stop(options.progress);
    return TopicMaker(found.report, found.models, options)
        .make(
            [&](const ClashLists& lists) {
                return clash_viewpoints(found, store, lists, viewpoint_options(options));
            },
            found.report.topics_revision);
}

} // namespace abut
