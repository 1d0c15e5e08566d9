#include "motion/engine_files.h"

#include <abut/error.h>
#include <abut/scene.h>

#include "arguments/interrupt.h"
#include "arguments/output_files.h"

#include <filesystem>
#include <fmt/format.h>

namespace abut::command {

int make_engine_files(const std::string& out, const scenes::EngineOptions& options,
                      const CommonOptions& common) {
    const std::filesystem::path file(out);
    if (!file.has_filename() || file.extension() != ".toml")
        throw Error(ErrorCode::bad_argument, out,
                    "cannot be written: an engine is written as FILE.toml");
    const std::string assembly_name = file.filename().string();
    const std::string model_name = file.stem().string() + ".glb";
    OutputFiles outputs(file.parent_path(), {assembly_name, model_name});
    const scenes::Engine engine = scenes::make_engine(options, model_name);
    {
        const InterruptScope scope(OnInterrupt::defer);
        outputs.stage(model_name, [&](const std::string& path) { write_glb(engine.scene, path); });
        outputs.stage_text(assembly_name, engine.assembly);
        throw_if_interrupted();
        outputs.commit();
    }
    std::size_t triangles = 0;
    for (const Mesh& mesh : engine.scene.meshes)
        triangles += mesh.triangles.size();
    if (common.json)
        print_json(dump({{"scene", "engine"},
                         {"triangles", triangles},
                         {"files", {outputs.path(assembly_name), outputs.path(model_name)}},
                         {"parts", engine.scene.parts.size()}}));
    else if (!common.quiet)
        print_text(fmt::format(
            "{}  {} parts, whose models are in {}\n", shown(outputs.path(assembly_name)),
            grouped(engine.scene.parts.size()), shown(outputs.path(model_name))));
    return kExitDone;
}

} // namespace abut::command
