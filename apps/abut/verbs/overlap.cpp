#include <abut/error.h>
#include <abut/shape_queries.h>

#include "commands.h"
#include "pair/two_models.h"
#include "verbs/one_model.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct OverlapArguments {
    OneModelOptions model;
    std::string sphere, box, box_pose, segment;
    bool all = false;
    std::string fail_on;
};

Vec3 point_at(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Calls answer(shape) with the shape that the arguments give.
template <typename Answer>
auto with_shape(const OverlapArguments& arguments, const Answer& answer) {
    if (!arguments.sphere.empty()) {
        const auto n = parse_numbers("--sphere", arguments.sphere, "x,y,z,radius", 4);
        if (n[3] < 0)
            throw Error(ErrorCode::bad_argument, "--sphere: the radius must not be negative");
        return answer(Sphere{point_at(n, 0), n[3]});
    }
    if (!arguments.segment.empty()) {
        const auto n = parse_numbers("--segment", arguments.segment, "x0,y0,z0,x1,y1,z1", 6);
        return answer(Segment{point_at(n, 0), point_at(n, 3)});
    }
    const auto n = parse_numbers("--box", arguments.box, "x0,y0,z0,x1,y1,z1", 6);
    const Box3 box{point_at(n, 0), point_at(n, 3)};
    if (n[0] > n[3] || n[1] > n[4] || n[2] > n[5])
        throw Error(ErrorCode::bad_argument, "--box: the lower corner must come first");
    if (arguments.box_pose.empty())
        return answer(box);
    return answer(OrientedBox{box, parse_pose("--box-pose", arguments.box_pose)});
}

int run(const OverlapArguments& arguments, const CommonOptions& common) {
    with_shape(arguments, [](const auto&) {}); // checks the shape before any file is read
    const OneModel model = load(arguments.model, common);
    const Stopwatch watch;
    std::vector<std::uint32_t> triangles;
    const bool overlap = with_shape(arguments, [&](const auto& shape) {
        if (!arguments.all)
            return overlaps(model.model, model.world_from_model, shape);
        triangles = overlapping_triangles(model.model, model.world_from_model, shape);
        return !triangles.empty();
    });
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer{{"model", arguments.model.file},
                                      {"frame", model.frame},
                                      {"all", arguments.all},
                                      {"overlap", overlap}};
        if (arguments.all)
            answer["triangles"] = triangles;
        answer["seconds"] = describe_seconds(model, seconds);
        print_json(dump(answer));
    } else if (!common.quiet) {
        std::string text = overlap ? "overlap\n" : "no overlap\n";
        for (const std::uint32_t triangle : triangles)
            text += fmt::format("triangle {}\n", triangle);
        print_text(text);
    }
    return overlap && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_overlap(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<OverlapArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"overlap",
         kOneModel,
         "Does a model's surface meet a sphere, a box or a segment?",
         {{"abut overlap a.obj --sphere 0,0,0,50mm --all",
           "the triangles that meet a ball of radius 50 mm at the origin"},
          {"abut overlap a.obj --box 0,0,0,1,1,1 --box-pose 0,0,2,1,0,0,0 --fail-on overlap",
           "a box two metres higher; exit status 1 if they meet"}},
         "they meet (with --fail-on overlap)"});
    add_one_model(*app, arguments->model);
    CLI::Option_group* shape = app->add_option_group("Shape", "exactly one");
    shape->add_option("--sphere", arguments->sphere, "Ball: centre and radius")
        ->check(not_empty("X,Y,Z,R"));
    CLI::Option* box = shape->add_option("--box", arguments->box, "Box: lower corner, upper corner")
                           ->check(not_empty("X0,Y0,Z0,X1,Y1,Z1"));
    shape->add_option("--segment", arguments->segment, "Segment: its ends")
        ->check(not_empty("X0,Y0,Z0,X1,Y1,Z1"));
    shape->require_option(1);
    app->add_option("--box-pose", arguments->box_pose,
                    "Pose of the box x,y,z,qw,qx,qy,qz (default: none)")
        ->needs(box)
        ->check(not_empty("POSE"));
    app->add_flag("--all", arguments->all, "List every triangle that meets it");
    add_fail_on(*app, arguments->fail_on, "overlap");
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
