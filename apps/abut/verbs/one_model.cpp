#include "verbs/one_model.h"

#include <abut/error.h>
#include <abut/scene.h>

#include "arguments/interrupt.h"
#include "pair/two_models.h"
#include "text/text_lines.h"

#include <fmt/format.h>
#include <utility>

namespace abut::command {

void add_one_model(CLI::App& app, OneModelOptions& options) {
    app.add_option("MODEL", options.file, fmt::format("Model: {}", kModelHelp))->required();
    app.add_option(
           "--pose", options.pose,
           "Pose of the model: translation and quaternion x,y,z,qw,qx,qy,qz (default: none)")
        ->check(not_empty("POSE"));
    add_read_options(app, options.read);
}

OneModel load(const OneModelOptions& options, const CommonOptions& common) {
    const Transform world_from_model =
        options.pose.empty() ? Transform() : Transform(parse_pose("--pose", options.pose));
    ProgressBar bar(common.progress_style());
    const Stopwatch import_watch;
    Mesh mesh;
    nlohmann::ordered_json frame;
    {
        const InterruptScope scope(OnInterrupt::ask);
        ReadOptions read = options.read;
        read.progress = bar.progress();
        const Scene scene = read_scene(parse_model_path(options.file), read);
        frame = describe_frame(scene.up, scene.file);
        mesh = to_mesh(scene);
    }
    throw_if_interrupted();
    bar.finish();
    const double seconds_import = import_watch.seconds();
    const Stopwatch build_watch;
    Model model(std::move(mesh));
    return {std::move(model), world_from_model, seconds_import, build_watch.seconds(),
            std::move(frame)};
}

nlohmann::ordered_json describe_seconds(const OneModel& model, double query) {
    return {{"import", model.seconds_import}, {"build", model.seconds_build}, {"query", query}};
}

void add_points(CLI::App& app, PointsOptions& options) {
    app.add_option("--point", options.points, "Point x,y,z; may be repeated")
        ->allow_extra_args(false)
        ->check(not_empty("X,Y,Z"));
    app.add_option("--points", options.file, "File with a point x,y,z on each line")
        ->check(not_empty("FILE"));
}

std::vector<Vec3> load(const PointsOptions& options) {
    std::vector<Vec3> points;
    for (const std::string& text : options.points)
        points.push_back(parse_point("--point", text));
    if (!options.file.empty()) {
        for_each_line(options.file, [&](std::size_t number, const std::string& line) {
            if (!line.empty() && line.front() != '#')
                points.push_back(
                    parse_point(fmt::format("{}: line {}", options.file, number), line));
        });
    }
    if (points.empty())
        throw Error(ErrorCode::bad_argument, "no point given: --point or --points is required");
    return points;
}

} // namespace abut::command
