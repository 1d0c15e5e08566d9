#include "pair/two_models.h"

#include <abut/error.h>
#include <abut/scene.h>

#include "arguments/choice.h"
#include "arguments/interrupt.h"
#include "text/text_lines.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace abut::command {

namespace {

constexpr std::array<Named<Volume>, 11> kVolumes{{{"automatic", Volume::automatic},
                                                  {"aabb", Volume::aabb},
                                                  {"sphere", Volume::sphere},
                                                  {"kdop14", Volume::kdop14},
                                                  {"kdop18", Volume::kdop18},
                                                  {"kdop26", Volume::kdop26},
                                                  {"obb", Volume::obb},
                                                  {"pss", Volume::pss},
                                                  {"lss", Volume::lss},
                                                  {"rss", Volume::rss},
                                                  {"ssv", Volume::ssv}}};

} // namespace

void add_two_models(CLI::App& app, TwoModelsOptions& options) {
    app.add_option("A", options.files[0], fmt::format("First model: {}", kModelHelp))->required();
    app.add_option("B", options.files[1],
                   "Second model, likewise; it is turned to the axes of the first")
        ->required();
    constexpr const char* kForm = "translation and quaternion x,y,z,qw,qx,qy,qz (default: none)";
    app.add_option("--pose-a", options.poses[0], fmt::format("Pose of A: {}", kForm))
        ->check(not_empty("POSE"));
    app.add_option("--pose-b", options.poses[1], fmt::format("Pose of B: {}", kForm))
        ->check(not_empty("POSE"));
    add_read_options(app, options.read);
}

void add_volume(CLI::App& app, TwoModelsOptions& options) {
    add_choice(app, "--volume", options.volume, kVolumes,
               "Kind of bounding volume; it does not change the answer");
}

Pose parse_pose(const std::string& option, const std::string& text) {
    const std::vector<double> numbers = parse_numbers(option, text, "x,y,z,qw,qx,qy,qz", 3);
    const Pose pose{{numbers[0], numbers[1], numbers[2]},
                    {numbers[3], numbers[4], numbers[5], numbers[6]}};
    if (std::all_of(pose.rotation.begin(), pose.rotation.end(), [](double q) { return q == 0; }))
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{}: the quaternion has zero length", option));
    return pose;
}

TwoModels load(const TwoModelsOptions& options, const CommonOptions& common) {
    const auto transform = [&](std::size_t side, const char* option) {
        const std::string& text = options.poses.at(side);
        return text.empty() ? Transform() : Transform(parse_pose(option, text));
    };
    const Transform world_from_a = transform(0, "--pose-a");
    const Transform world_from_b = transform(1, "--pose-b");

    ProgressBar bar(common.progress_style());
    const Stopwatch import_watch;
    std::array<Mesh, 2> meshes;
    UpAxis up{};
    {
        const InterruptScope scope(OnInterrupt::ask);
        ReadOptions read = options.read;
        read.progress = bar.progress();
        std::vector<Scene> scenes =
            read_scenes(parse_model_paths({options.files[0], options.files[1]}), read);
        into_one_frame(scenes);
        up = scenes[0].up;
        for (std::size_t side = 0; side < 2; ++side) {
            meshes.at(side) = to_mesh(scenes.at(side));
            scenes.at(side) = {};
        }
    }
    throw_if_interrupted();
    bar.finish();
    const double seconds_import = import_watch.seconds();

    const Stopwatch build_watch;
    const ModelOptions build{.volume = options.volume};
    Model a(std::move(meshes[0]), build);
    Model b(std::move(meshes[1]), build);
    return {std::move(a),
            std::move(b),
            world_from_a,
            world_from_b,
            seconds_import,
            build_watch.seconds(),
            up};
}

void add_poses(CLI::App& app, PosesOption& option) {
    app.add_option("--poses", option.file,
                   "File with a pose of B in each row, as for --pose-b; one answer for each row")
        ->check(not_empty("FILE"))
        ->excludes("--pose-b");
}

std::vector<Pose> read_poses(const std::string& file) {
    std::vector<Pose> poses;
    for_each_line(file, [&](std::size_t number, std::string line) {
        std::erase_if(line, [](char c) { return c == ' ' || c == '\t'; });
        if (line.empty() || line[0] == '#')
            return;
        try {
            poses.push_back(parse_pose(fmt::format("line {}", number), line));
        } catch (const Error& error) {
            throw Error(ErrorCode::malformed, file, error.what());
        }
    });
    return poses;
}

std::vector<Placement> placements(const TwoModels& models, const std::vector<Pose>& poses_of_b) {
    std::vector<Placement> result;
    result.reserve(poses_of_b.size());
    for (const Pose& pose : poses_of_b)
        result.push_back({models.world_from_a, pose});
    return result;
}

nlohmann::ordered_json describe(const TwoModelsOptions& options) {
    return {{"a", options.files[0]}, {"b", options.files[1]}};
}

nlohmann::ordered_json describe_frame(const TwoModelsOptions& options, const TwoModels& models) {
    return describe_frame(models.up, parse_model_path(options.files[0]).path);
}

nlohmann::ordered_json describe_feature(Feature kind, std::uint8_t index) {
    return {{"kind", to_string(kind)}, {"index", index}};
}

nlohmann::ordered_json describe(const Counters& counters) {
    return {{"volume", to_string(counters.volume)},
            {"volume_tests", counters.volume_tests},
            {"primitive_tests", counters.primitive_tests},
            {"exact_tests", counters.exact_tests}};
}

nlohmann::ordered_json to_json(const std::vector<TrianglePair>& pairs) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const TrianglePair& pair : pairs)
        json.push_back({pair.a, pair.b});
    return json;
}

nlohmann::ordered_json describe_seconds(const TwoModels& models, double query) {
    return {{"import", models.seconds_import}, {"build", models.seconds_build}, {"query", query}};
}

} // namespace abut::command
