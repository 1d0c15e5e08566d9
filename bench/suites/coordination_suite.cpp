#include <abut/bcf.h>
#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/part_query.h>
#include <abut/properties.h>

#include "measure.h"
#include "placement.h"
#include "suite.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

struct CoordinationOptions {
    std::size_t clashes = 100'000, topics = 1'000;
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// A building of 8 storeys and its clashes: half of them lie along floors, the others anywhere.
class CoordinationSuite {
public:
    explicit CoordinationSuite(const CoordinationOptions& options)
        : options_(options), random_(options.seed), models_(2) {
        report_.suite = "coordination";
        add_parts();
        for (std::size_t i = 0; i < options.clashes; ++i)
            add_clash(i);
    }

    Report run() && {
        group_rows();
        query_rows();
        bcf_rows();
        return std::move(report_);
    }

private:
    static constexpr std::uint32_t kFloors = 200;

    void add_parts() {
        PropertiesBuilder properties;
        const auto parts = static_cast<std::uint32_t>(options_.clashes / 2 + kFloors);
        models_[0].file = "a.ifc", models_[1].file = "b.ifc";
        for (std::uint32_t i = 0; i < parts; ++i) {
            properties.add("storey", fmt::format("Level {}", i % 8));
            properties.add("Pset_Common.Number", std::to_string(i % 1000));
            properties.next_part();
            for (Scene& model : models_) {
                Part& part = model.parts.emplace_back();
                part.id = fmt::format("{}{:08}", model.file, i);
                part.name = fmt::format("part {}", i);
                part.type = i % 3 == 0 ? "IfcPipeSegment" : "IfcBeam";
            }
        }
        models_[0].properties = models_[1].properties = properties.finish(parts);
    }

    void add_clash(std::size_t number) {
        Clash clash;
        clash.id = 1 + number * 0x9e3779b97f4a7c15U;
        const auto parts = static_cast<double>(models_[0].parts.size());
        const bool on_floor = number % 2 == 0;
        clash.model = {0, 1};
        clash.part = {static_cast<std::uint32_t>(unit(random_) * (on_floor ? kFloors : parts)),
                      static_cast<std::uint32_t>(unit(random_) * parts)};
        clash.point_a = {300 * unit(random_), 300 * unit(random_), 40 * unit(random_)};
        clash.point_b = clash.point_a;
        clash.distance = -0.1 * unit(random_);
        clashes_.clashes.push_back(clash);
    }

    template <typename Ours>
    void row(const std::string& name, std::size_t items, const std::string& unit, const Ours& ours,
             const std::string& counter) {
        double counted = 0;
        const Turns turns =
            take_turns(options_.rounds, [&] { counted = static_cast<double>(ours()); }, {});
        Row row{name, 1e6 * turns.ours / static_cast<double>(items), {}, {}, unit, 1, {}};
        row.counters[counter] = counted;
        report_.rows.push_back(row);
    }

    void group_rows() {
        const auto group = [&](const std::string& by, std::vector<EarlierGroup> earlier) {
            return group_clashes(clashes_, models_,
                                 {.by = parse_grouping(by), .earlier = std::move(earlier)});
        };
        for (const char* const by : {"part,place", "place", "storey,part"})
            row(
                fmt::format("group_clashes {}", by), options_.clashes, "us/clash",
                [&] { return innermost_groups(group(by, {})).size(); }, "groups");
        std::vector<EarlierGroup> places;
        for (const ClashGroup& place : group("place", {}))
            places.push_back({place.id, {}, place.name, place.kind, place.key, place.centre, {}});
        row(
            "group_clashes place, new clashes at earlier places", options_.clashes, "us/clash",
            [&] { return group("place", places).size(); }, "groups");
        clashes_.groups = group("part,place", {});
    }

    void query_rows() {
        const auto query = PartQuery::parse(
            "type = IfcPipe*, IfcDuct* and storey = \"Level 2\" and Pset_Common.Number < 500");
        row(
            "PartQuery on parts", models_[0].parts.size(), "us/part",
            [&] {
                std::size_t matches = 0;
                for (std::uint32_t i = 0; i < models_[0].parts.size(); ++i)
                    matches += query.matches(models_[0], i) ? 1 : 0;
                return matches;
            },
            "matches");
        const auto of_clashes = ClashQuery::parse("depth > 0.05 and group.size >= 10 and a.type = "
                                                  "IfcBeam");
        row(
            "ClashQuery on a report", options_.clashes, "us/clash",
            [&] { return of_clashes.find(clashes_, models_).size(); }, "matches");
    }

    void bcf_rows() {
        BcfFile file;
        for (std::size_t i = 0; i < options_.topics; ++i) {
            BcfTopic& topic = file.topics.emplace_back();
            topic.guid = topic.folder = group_topic_guid(std::to_string(i));
            topic.title = fmt::format("Topic {}", i);
            topic.status = "Open";
            BcfViewpoint& view = topic.viewpoints.emplace_back();
            view.guid = group_topic_guid("view" + std::to_string(i));
            view.file = "viewpoint.bcfv";
            view.perspective.emplace();
            view.has_components = true;
            view.selection.resize(20);
            for (std::size_t k = 0; k < view.selection.size(); ++k)
                view.selection[k].ifc_guid = fmt::format("{:022}", 20 * i + k);
        }
        std::string bytes;
        row(
            "bcf_bytes, topics of 20 parts", options_.topics, "us/topic",
            [&] {
                bytes = bcf_bytes(file, BcfVersion::v3_0);
                return bytes.size();
            },
            "bytes");
        row(
            "parse_bcf of these", options_.topics, "us/topic",
            [&] { return parse_bcf(bytes, "topics.bcf").topics.size(); }, "topics");
    }

    const CoordinationOptions& options_;
    scenes::Random random_;
    std::vector<Scene> models_;
    ClashReport clashes_;
    Report report_;
};

const Suite kCoordinationSuite(
    "coordination", "Groups of clashes, conditions and BCF files", [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<CoordinationOptions>();
        suite.add_option("--clashes", options->clashes, "Number of clashes");
        suite.add_option("--topics", options->topics, "Number of topics in the BCF file");
        add_rounds(suite, options->rounds);
        suite.add_option("--seed", options->seed, "Of the clashes");
        return [options] { return CoordinationSuite(*options).run(); };
    });

} // namespace

} // namespace abut::bench
