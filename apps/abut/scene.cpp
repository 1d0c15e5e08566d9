#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>

#include "commands.h"
#include "interrupt.h"
#include "output_files.h"
#include "scenes/plant.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace abut::command {

namespace {

constexpr std::uint64_t kMostTriangles = 1'000'000'000;
constexpr std::uint64_t kMostClashes = 1'000'000; // PlantOptions counts them as int

struct SceneArguments {
    std::string name, out;
    PlantOptions plant;
};

std::string summary(const Plant& plant, const std::string& scene_path,
                    const std::string& truth_path) {
    std::string text =
        fmt::format("{}  {} parts, {} meshes, {} triangles\n{}  {} planted\n", scene_path,
                    grouped(plant.scene.parts.size()), grouped(plant.scene.meshes.size()),
                    grouped(plant.triangles), truth_path, grouped(plant.truth.size()));
    for (const ClashKind kind : kClashKinds)
        text += fmt::format("  {:<10} {:>9}\n", abut::to_string(kind),
                            std::count_if(plant.truth.begin(), plant.truth.end(),
                                          [&](const auto& clash) { return clash.kind == kind; }));
    return text;
}

int run(const SceneArguments& arguments, const CommonOptions& common) {
    const std::filesystem::path file(arguments.out);
    if (!file.has_filename() || file.extension() != ".glb")
        throw Error(ErrorCode::bad_argument, arguments.out,
                    "cannot be written: a scene is written as FILE.glb");
    const std::string scene_name = file.filename().string();
    const std::string truth_name = file.stem().string() + ".truth.json";
    OutputFiles outputs(file.parent_path(), {scene_name, truth_name});
    ProgressBar bar(common.progress_style());

    bar.show("scene", 0);
    const Plant plant = make_plant(arguments.plant);
    const std::string truth = plant_truth_json(plant);
    bar.show("write", 0);
    {
        const InterruptScope scope(OnInterrupt::defer);
        outputs.stage(scene_name, [&](const std::string& path) { write_glb(plant.scene, path); });
        throw_if_interrupted();
        outputs.stage_text(truth_name, truth);
        throw_if_interrupted();
        outputs.commit();
    }
    bar.finish();
    if (common.json)
        print(truth);
    else if (!common.quiet)
        print(summary(plant, outputs.path(scene_name), outputs.path(truth_name)));
    return kExitDone;
}

} // namespace

Subcommand add_scene(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<SceneArguments>();
    CLI::App* app = add_subcommand(root, common, "scene",
                                   "Make a procedural scene and the truth that it holds");
    app->add_option("NAME", arguments->name, "plant: a power plant with planted clashes")
        ->required()
        ->check(CLI::IsMember({"plant"}));
    app->add_option("--out", arguments->out, "FILE.glb to write; the truth goes to FILE.truth.json")
        ->required();
    app->add_option("--triangles", arguments->plant.triangles, "About how many triangles")
        ->check(whole_number(1, kMostTriangles));
    app->add_option("--clashes", arguments->plant.clashes,
                    "How many clashes to plant, of the kinds in turn")
        ->check(whole_number(0, kMostClashes));
    app->add_option("--seed", arguments->plant.seed, "Seed of everything random")
        ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
    app->add_option("--clearance", arguments->plant.clearance,
                    "Up to this clearance, in metres, nothing but the planted pairs is near")
        ->check(not_negative());
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
