#include <abut/clash_bcf.h>

#include "bcf/bcf_parts.h"
#include "clash/bcf/topic_fields.h"
#include "clash/bcf/topic_viewpoint.h"
#include "core/arguments.h"
#include "core/stop.h"
#include "core/uuid.h"

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

/// The name space of the GUIDs of topics. It must never change.
constexpr std::string_view kTopicSpace = "7b0a6a52-6c1e-5f0d-9a83-2f4f6a1f5c20";

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
        for (const Scene& scene : models)
            files_.push_back({scene.project,
                              "",
                              true,
                              std::filesystem::path(scene.file).filename().string(),
                              time_of_file(scene.file),
                              scene.file,
                              {}});
    }

    BcfFile make(const MakeViewpoints& make_viewpoints) {
        const std::vector<ClashTopic> topics =
            options_.topics.empty() ? topics_of_clashes() : options_.topics;
        ClashLists lists;
        for (const ClashTopic& topic : topics) {
            lists.push_back(topic.clashes);
            for (const std::uint32_t clash : topic.clashes)
                require(clash < report_.clashes.size(), "the report has no clash of this index");
        }
        const std::vector<ClashViewpoint> views = make_viewpoints(lists);
        BcfFile file;
        for (std::size_t i = 0; i < topics.size(); ++i) {
            poll_stop();
            file.topics.push_back(topic_of(topics[i], views[i]));
        }
        std::ranges::sort(file.topics, {}, &BcfTopic::folder);
        if (!options_.project.empty()) {
            file.project_name = options_.project;
            file.project_id = missing_guid("project " + options_.project);
        }
        state_words(file);
        return file;
    }

private:
    /// One topic for each id: a clash that is found twice is one clash.
    [[nodiscard]] std::vector<ClashTopic> topics_of_clashes() const {
        std::vector<ClashTopic> topics;
        std::unordered_map<std::uint64_t, std::size_t> known;
        for (std::uint32_t i = 0; i < report_.clashes.size(); ++i) {
            const auto [at, is_new] = known.emplace(report_.clashes[i].id, topics.size());
            if (is_new)
                topics.push_back({});
            topics[at->second].clashes.push_back(i);
        }
        return topics;
    }

    [[nodiscard]] std::string title_of(const std::vector<std::uint32_t>& clashes) const {
        if (clashes.empty())
            return "";
        const Clash& clash = report_.clashes[clashes.front()];
        const auto name = [&](std::size_t side) {
            const Part& part = models_.at(clash.model.at(side)).parts.at(clash.part.at(side));
            return part.name.empty() ? part.id : part.name;
        };
        return name(0) + " \u00D7 " + name(1);
    }

    [[nodiscard]] BcfTopic topic_of(const ClashTopic& given, const ClashViewpoint& view) const {
        BcfTopic topic = given.topic;
        const auto state = [](std::string& text, const std::string& otherwise) {
            if (text.empty())
                text = otherwise;
        };
        std::string ids;
        for (const std::uint32_t index : given.clashes)
            ids += (ids.empty() ? "clash " : " ") + clash_id_text(report_.clashes[index].id);
        if (given.clashes.size() > 1 &&
            report_.clashes[given.clashes[0]].id == report_.clashes[given.clashes[1]].id)
            ids = "clash " + clash_id_text(report_.clashes[given.clashes[0]].id);
        state(topic.guid, uuid_of_name(kTopicSpace, ids));
        state(topic.folder, topic.guid);
        state(topic.title, title_of(given.clashes));
        state(topic.type, "Clash");
        state(topic.status, status_of(given.clashes));
        for (const std::uint32_t index : given.clashes)
            state(topic.priority, report_.clashes[index].severity);
        state(topic.creation_author, options_.author);
        state(topic.creation_date, bcf_time(time_));
        if (given.clashes.empty())
            return topic;
        describe(topic, given.clashes);
        std::set<std::uint32_t> models;
        for (const std::uint32_t index : given.clashes)
            models.insert(report_.clashes[index].model.begin(), report_.clashes[index].model.end());
        for (const std::uint32_t model : models)
            topic.files.push_back(files_.at(model));
        BcfViewpoint viewpoint =
            topic_viewpoint(view, report_.frame.up, models_, topic.guid, options_.clip);
        if (options_.snapshot)
            viewpoint.snapshot = options_.snapshot(view);
        if (!viewpoint.snapshot.empty())
            viewpoint.snapshot_file = "snapshot.png";
        topic.viewpoints.insert(topic.viewpoints.begin(), std::move(viewpoint));
        return topic;
    }

    /// Approved if all clashes are, which only a store knows.
    [[nodiscard]] std::string status_of(const std::vector<std::uint32_t>& clashes) const {
        const bool is_approved = std::ranges::all_of(clashes, [&](std::uint32_t index) {
            return report_.clashes[index].status == ClashStatus::approved;
        });
        return is_approved && !clashes.empty() ? "Approved" : "Open";
    }

    /// Adds the words that follow from the clashes. An import takes them away again.
    void describe(BcfTopic& topic, const std::vector<std::uint32_t>& clashes) const {
        std::array<std::uint64_t, 5> counts{};
        std::set<std::string> labels;
        double deepest = 0;
        for (const std::uint32_t index : clashes) {
            const Clash& clash = report_.clashes[index];
            ++counts.at(static_cast<std::size_t>(clash.kind));
            deepest = std::min(deepest, clash.distance);
            labels.insert(std::string("kind: ") + abut::to_string(clash.kind));
            for (std::size_t side = 0; side < 2; ++side)
                for (const char* const name : {"storey", "discipline"})
                    if (const std::string_view value =
                            models_.at(clash.model.at(side))
                                .properties.value(clash.part.at(side), name);
                        !value.empty())
                        labels.insert(name + std::string(": ") + std::string(value));
        }
        topic.labels.insert(topic.labels.end(), labels.begin(), labels.end());
        std::string words(kDerivedLine);
        const char* comma = "";
        for (const ClashKind kind : kClashKinds)
            if (const std::uint64_t count = counts.at(static_cast<std::size_t>(kind)); count > 0) {
                words += fmt::format("{}{} {}", comma, count, abut::to_string(kind));
                comma = ", ";
            }
        if (deepest < 0)
            words += fmt::format("; at most {:.3f} m deep", -deepest);
        topic.description += (topic.description.empty() ? "" : "\n") + words;
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
    std::vector<BcfHeaderFile> files_; ///< by model
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
    return TopicMaker(found.report, found.models, options).make([&](const ClashLists& lists) {
        return clash_viewpoints(found, store, lists, viewpoint_options(options));
    });
}

} // namespace abut
