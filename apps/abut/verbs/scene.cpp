#include <abut/error.h>

#include "commands.h"
#include "motion/engine_files.h"
#include "verbs/scene_frames.h"
#include "verbs/scene_plant.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

constexpr std::uint64_t kMostTriangles = 1'000'000'000;
constexpr std::uint64_t kMostClashes = 1'000'000; // PlantOptions counts them as int
constexpr std::uint64_t kMostFrames = 10'000;     // file names have four digits
constexpr const char* kPlant = "plant";
constexpr const char* kEngine = "engine";

struct SceneArguments {
    std::string name, out;
    std::optional<std::uint64_t> triangles, frames;
    std::optional<int> clashes;
    std::optional<double> clearance;
    std::uint64_t seed = 1;
    bool distinct = false;
};

/// Errors      Error{bad_argument} if the option is given.
template <class Value>
void refuse(const char* option, const std::optional<Value>& value, const std::string& scene) {
    if (value)
        throw Error(ErrorCode::bad_argument, option,
                    fmt::format("the scene '{}' has no such option", scene));
}

int make_plant_scene(const SceneArguments& arguments, const CommonOptions& common) {
    refuse("--frames", arguments.frames, arguments.name);
    PlantOptions options;
    options.triangles = arguments.triangles.value_or(options.triangles);
    options.clashes = arguments.clashes.value_or(options.clashes);
    options.clearance = arguments.clearance.value_or(options.clearance);
    options.seed = arguments.seed;
    options.distinct = arguments.distinct;
    return make_plant_files(arguments.out, options, common);
}

int make_deforming(const DeformingSceneInfo& scene, const SceneArguments& arguments,
                   const CommonOptions& common) {
    refuse("--clashes", arguments.clashes, arguments.name);
    refuse("--clearance", arguments.clearance, arguments.name);
    refuse("--distinct", arguments.distinct ? std::optional(true) : std::nullopt, arguments.name);
    return make_frame_files(
        arguments.name, arguments.out, arguments.frames.value_or(scene.frames),
        {.triangles = arguments.triangles.value_or(scene.triangles), .seed = arguments.seed},
        common);
}

int make_engine_scene(const SceneArguments& arguments, const CommonOptions& common) {
    refuse("--frames", arguments.frames, arguments.name);
    refuse("--triangles", arguments.triangles, arguments.name);
    refuse("--clearance", arguments.clearance, arguments.name);
    refuse("--distinct", arguments.distinct ? std::optional(true) : std::nullopt, arguments.name);
    const int clashes = arguments.clashes.value_or(2);
    if (clashes != 0 && clashes != 2)
        throw Error(ErrorCode::bad_argument, "--clashes", "an engine has 0 or 2 planted clashes");
    return make_engine_files(arguments.out, {.clashes = clashes > 0}, common);
}

int run(const SceneArguments& arguments, const CommonOptions& common) {
    if (arguments.name == kEngine)
        return make_engine_scene(arguments, common);
    const auto* deforming =
        std::ranges::find(kDeformingScenes, arguments.name, &DeformingSceneInfo::name);
    return deforming == kDeformingScenes.end() ? make_plant_scene(arguments, common)
                                               : make_deforming(*deforming, arguments, common);
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names{kPlant, kEngine};
    for (const DeformingSceneInfo& scene : kDeformingScenes)
        names.emplace_back(scene.name);
    return names;
}

std::string scene_help() {
    std::string text = "plant: a power plant with planted clashes; engine: an assembly in motion, "
                       "for abut motion";
    for (const DeformingSceneInfo& scene : kDeformingScenes)
        text += fmt::format("; {}: {}", scene.name, scene.description);
    return text;
}

} // namespace

Subcommand add_scene(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<SceneArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"scene",
         kScenes,
         "Generate a scene: a plant with a list of its clashes, an engine in motion, or frames of "
         "a "
         "deforming surface",
         {{"abut scene plant --triangles 50000 --clashes 20 --out plant.glb",
           "a power plant, and its planted clashes in plant.truth.json"},
          {"abut scene twist --frames 5 --triangles 2000 --out frames",
           "five frames of a twisting tube: frames/twist-0000.ply and so on"},
          {"abut scene engine --out crank/engine.toml",
           "crank, rods and pistons for abut motion, and their models in crank/engine.glb"}},
         ""});
    app->add_option("NAME", arguments->name, scene_help())
        ->required()
        ->check(CLI::IsMember(scene_names()));
    app->add_option("--out", arguments->out,
                    "plant: FILE.glb to write, with the clashes in FILE.truth.json. engine: "
                    "FILE.toml to write, with the models in FILE.glb. Frames: a folder for "
                    "NAME-0000.ply and so on, or FILE.ply for FILE-0000.ply and so on")
        ->required()
        ->check(not_empty("FILE"));
    app->add_option("--triangles", arguments->triangles, "Approximate number of triangles")
        ->check(whole_number(1, kMostTriangles));
    app->add_option("--frames", arguments->frames, "Number of frames; not for plant and engine")
        ->check(whole_number(1, kMostFrames));
    app->add_option(
           "--clashes", arguments->clashes,
           "Number of clashes to plant, of each kind in turn; engine: 0 or 2; not for frames")
        ->check(whole_number(0, kMostClashes));
    app->add_option("--seed", arguments->seed, "Seed of the random numbers")
        ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
    add_length(*app, "--clearance", arguments->clearance,
               "Clearance up to which only planted pairs are near; only for plant");
    app->add_flag("--distinct", arguments->distinct,
                  "Give every part its own mesh; only for plant");
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
