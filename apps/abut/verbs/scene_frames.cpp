#include "verbs/scene_frames.h"

#include <abut/frame.h>

#include "arguments/interrupt.h"
#include "arguments/output_files.h"

#include <filesystem>
#include <fmt/format.h>
#include <vector>

namespace abut::command {

namespace {

std::vector<std::string> file_names(const std::string& stem, std::uint64_t frames) {
    std::vector<std::string> names;
    for (std::uint64_t frame = 0; frame < frames; ++frame)
        names.push_back(fmt::format("{}-{:04}.ply", stem, frame));
    return names;
}

nlohmann::ordered_json summary(const std::string& name, std::uint64_t seed, const Mesh& last,
                               const std::vector<std::string>& paths) {
    return {{"scene", name},
            {"seed", seed},
            {"frames", paths.size()},
            {"vertices", last.positions.size()},
            {"triangles", last.triangles.size()},
            {"files", paths}};
}

} // namespace

int make_frame_files(const std::string& name, const std::string& out, std::uint64_t frames,
                     const DeformingOptions& options, const CommonOptions& common) {
    const std::filesystem::path path(out);
    const bool is_pattern = path.extension() == ".ply";
    const std::vector<std::string> names =
        file_names(is_pattern ? path.stem().string() : name, frames);
    OutputFiles outputs(is_pattern ? path.parent_path() : path, names);
    ProgressBar bar(common.progress_style());

    bar.show("scene", 0);
    const auto scene = make_deforming_scene(name, options);
    std::vector<std::string> paths;
    {
        const InterruptScope scope(OnInterrupt::defer);
        for (const std::string& file : names) {
            bar.show("frames", static_cast<double>(paths.size()) / static_cast<double>(frames));
            if (!paths.empty())
                scene->step();
            outputs.stage(file, [&](const std::string& to) { write_frame(scene->mesh(), to); });
            paths.push_back(outputs.path(file));
            throw_if_interrupted();
        }
        outputs.commit();
    }
    bar.finish();
    const Mesh& last = scene->mesh();
    if (common.json)
        print_json(dump(summary(name, options.seed, last, paths)));
    else if (!common.quiet)
        print_text(fmt::format("{} to {}  {} frames; in the last {} triangles, {} vertices\n",
                               shown(paths.front()), shown(paths.back()), grouped(frames),
                               grouped(last.triangles.size()), grouped(last.positions.size())));
    return kExitDone;
}

} // namespace abut::command
