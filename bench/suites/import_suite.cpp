#include <abut/error.h>
#include <abut/scene.h>

#include "measure.h"
#include "suite.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

struct ImportSuiteOptions {
    std::vector<std::string> files;
    int rounds = 7;
};

/// Reads a file with Assimp in this process, without isolation and checks. Returns what
/// `read_scene` would, as far as reading the file goes.
class InProcessReader {
public:
    Scene read(const std::string& file) {
        const double start = wall_seconds();
        Assimp::Importer importer;
        importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
        const aiScene* source = importer.ReadFile(file, 0);
        if (source == nullptr)
            throw Error(ErrorCode::malformed, file, importer.GetErrorString());
        assimp_seconds.push_back(wall_seconds() - start);
        scene_ = {file, {}, {}};
        mesh_of_.clear();
        take_node(*source, *source->mRootNode, aiMatrix4x4t<double>());
        return std::move(scene_);
    }

    std::vector<double> assimp_seconds; ///< Assimp's part of the time, for each file read

private:
    void take_node(const aiScene& source, const aiNode& node,
                   const aiMatrix4x4t<double>& world_from_parent) {
        const aiMatrix4x4& m = node.mTransformation;
        const aiMatrix4x4t<double> world =
            world_from_parent * aiMatrix4x4t<double>(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,
                                                     m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3,
                                                     m.d4);
        if (node.mNumMeshes > 0) {
            Part part;
            part.id = part.name = node.mName.C_Str();
            if (node.mMetaData != nullptr) {
                aiString text;
                if (node.mMetaData->Get("name", text))
                    part.name = text.C_Str();
                if (node.mMetaData->Get("type", text))
                    part.type = text.C_Str();
            }
            part.mesh = take_mesh(source, {node.mMeshes, node.mMeshes + node.mNumMeshes});
            part.world_from_mesh =
                Transform({world.a1, world.b1, world.c1, world.a2, world.b2, world.c2, world.a3,
                           world.b3, world.c3, world.a4, world.b4, world.c4});
            scene_.parts.push_back(std::move(part));
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            take_node(source, *node.mChildren[i], world);
    }

    std::uint32_t take_mesh(const aiScene& source, const std::vector<unsigned>& list) {
        const auto [found, is_new] =
            mesh_of_.try_emplace(list, static_cast<std::uint32_t>(scene_.meshes.size()));
        if (!is_new)
            return found->second;
        Mesh& mesh = scene_.meshes.emplace_back();
        for (const unsigned index : list) {
            const aiMesh& part = *source.mMeshes[index];
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (unsigned i = 0; i < part.mNumVertices; ++i)
                mesh.positions.push_back(
                    {part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z});
            for (unsigned i = 0; i < part.mNumFaces; ++i) {
                const aiFace& face = part.mFaces[i];
                for (unsigned k = 2; k < face.mNumIndices; ++k)
                    mesh.triangles.push_back({first + face.mIndices[0],
                                              first + face.mIndices[k - 1],
                                              first + face.mIndices[k]});
            }
        }
        return found->second;
    }

    Scene scene_;
    std::map<std::vector<unsigned>, std::uint32_t> mesh_of_;
};

std::size_t triangles_of(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        count += mesh.triangles.size();
    return count;
}

Row compare(const std::string& file, int rounds) {
    Row row{file.substr(file.find_last_of('/') + 1), 0, {}, {}, "ms", 1, {}};
    InProcessReader peer;
    const Turns turns = take_turns(
        rounds,
        [&] {
            const Scene scene = read_scene(file);
            row.counters["parts"] = static_cast<double>(scene.parts.size());
            row.counters["triangles"] = static_cast<double>(triangles_of(scene));
        },
        [&] {
            const Scene scene = peer.read(file);
            row.counters["their parts"] = static_cast<double>(scene.parts.size());
            row.counters["their triangles"] = static_cast<double>(triangles_of(scene));
        });
    row.counters["Assimp's share of theirs, ms"] = 1e3 * median(peer.assimp_seconds);
    row.ours = 1e3 * turns.ours;
    row.peer = "Assimp in process";
    row.theirs = 1e3 * turns.theirs;
    return row;
}

/// Measures `read_scene`, whose reader runs in a process of its own, against Assimp in this
/// process.
///
/// Errors      as read_scene.
Report run_import_suite(const ImportSuiteOptions& options) {
    Report report{"import", {}, {}};
    Row sum{"all, one after another", 0, "Assimp in process", 0, "ms", 1, {}};
    for (const std::string& file : options.files) {
        report.rows.push_back(compare(file, options.rounds));
        sum.ours += report.rows.back().ours;
        *sum.theirs += *report.rows.back().theirs;
    }
    report.rows.push_back(sum);
    report.notes.emplace_back(
        "wall time; both end with the parts in memory; ours adds the reader's process and checks");
    return report;
}

const Suite
    kImportSuite("import", "Models read in isolation, against Assimp in process",
                 [](CLI::App& suite) -> RunSuite {
                     const auto options = std::make_shared<ImportSuiteOptions>();
                     suite.add_option("files", options->files, "Model files (GLB)")->required();
                     add_rounds(suite, options->rounds);
                     return [options] { return run_import_suite(*options); };
                 });

} // namespace

} // namespace abut::bench
