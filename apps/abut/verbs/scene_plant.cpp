#include "verbs/scene_plant.h"

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>

#include "arguments/interrupt.h"
#include "arguments/output_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace abut::command {

namespace {

std::string summary(const Plant& plant, const std::string& scene_path,
                    const std::string& truth_path) {
    std::string text =
        fmt::format("{}  {} parts, {} meshes, {} triangles\n{}  {} planted\n", shown(scene_path),
                    grouped(plant.scene.parts.size()), grouped(plant.scene.meshes.size()),
                    grouped(plant.triangles), shown(truth_path), grouped(plant.truth.size()));
    for (const ClashKind kind : kClashKinds) {
        if (kind == ClashKind::undecided)
            continue; // none is planted
        text += fmt::format("  {:<10} {:>9}\n", abut::to_string(kind),
                            std::count_if(plant.truth.begin(), plant.truth.end(),
                                          [&](const auto& clash) { return clash.kind == kind; }));
    }
    return text;
}

} // namespace

int make_plant_files(const std::string& out, const PlantOptions& options,
                     const CommonOptions& common) {
    const std::filesystem::path file(out);
    if (!file.has_filename() || file.extension() != ".glb")
        throw Error(ErrorCode::bad_argument, out,
                    "cannot be written: a scene is written as FILE.glb");
    const std::string scene_name = file.filename().string();
    const std::string truth_name = file.stem().string() + ".truth.json";
    OutputFiles outputs(file.parent_path(), {scene_name, truth_name});
    ProgressBar bar(common.progress_style());

    bar.show("scene", 0);
    const Plant plant = make_plant(options);
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
        print_json(truth);
    else if (!common.quiet)
        print_text(summary(plant, outputs.path(scene_name), outputs.path(truth_name)));
    return kExitDone;
}

} // namespace abut::command
