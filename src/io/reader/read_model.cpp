#include "io/reader/read_model.h"

#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/polygon/triangulate.h"
#include "io/process/scene_stream.h"
#include "io/reader/collada_asset.h"
#include "io/reader/fbx_frame.h"
#include "io/reader/joined_vertices.h"
#include "io/reader/material_colour.h"
#include "io/reader/node_parts.h"
#include "io/reader/threemf.h"
#include "io/scene/colour.h"

#include <algorithm>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <span>

namespace abut {

namespace {

constexpr std::uint64_t kLargestMesh = std::numeric_limits<std::uint32_t>::max() - 1;

/// Lets Assimp open the model and no other file. Otherwise it would follow any path to textures and
/// other files, which are not needed.
class OnlyTheModel : public Assimp::DefaultIOSystem {
public:
    explicit OnlyTheModel(std::string model) : model_(std::move(model)) {}
    bool Exists(const char* file) const override {
        return file == model_ && DefaultIOSystem::Exists(file);
    }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        return file == model_ ? DefaultIOSystem::Open(file, mode) : nullptr;
    }

private:
    std::string model_;
};

const aiScene& import(Assimp::Importer& importer, const std::string& file) {
    // Without Assimp's post-processing, which joins, drops and moves vertices. Polygons are cut
    // here.
    const aiScene* const scene = importer.ReadFile(file, 0);
    if (scene == nullptr) {
        if (const std::exception_ptr& fault = importer.GetException()) {
            try {
                std::rethrow_exception(fault);
            } catch (const std::bad_alloc&) {
                throw;
            } catch (...) { // NOLINT: its text is reported below
            }
        }
        malformed(importer.GetErrorString());
    }
    if (scene->mRootNode == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
        malformed("is incomplete");
    return *scene;
}

std::uint64_t triangle_count(const aiMesh& mesh) {
    if (mesh.mPrimitiveTypes == aiPrimitiveType_TRIANGLE)
        return mesh.mNumFaces;
    std::uint64_t count = 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
        if (mesh.mFaces[i].mNumIndices >= 3)
            count += mesh.mFaces[i].mNumIndices - 2;
    return count;
}

/// The meshes of Assimp that form one mesh of the scene: a node's primitives, in order.
using MeshList = std::vector<unsigned>;

struct Sizes {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

Sizes sizes_of(const aiScene& scene, const MeshList& list) {
    Sizes sizes;
    for (const unsigned mesh : list) {
        sizes.vertices += scene.mMeshes[mesh]->mNumVertices;
        sizes.triangles += triangle_count(*scene.mMeshes[mesh]);
    }
    if (std::max(sizes.vertices, sizes.triangles) > kLargestMesh)
        throw Fault(ErrorCode::unsupported, "has a part with more than 4 billion vertices");
    return sizes;
}

/// The colour that covers the most triangles of a mesh.
std::optional<Colour> colour_of(const aiScene& scene, const MeshList& list) {
    ColourTally colours;
    for (const unsigned number : list) {
        const aiMesh& mesh = *scene.mMeshes[number];
        colours.add(mesh.mMaterialIndex < scene.mNumMaterials
                        ? colour_of_material(*scene.mMaterials[mesh.mMaterialIndex])
                        : std::nullopt,
                    triangle_count(mesh));
    }
    return colours.largest();
}

/// In          number_of: the index under which each of the mesh's vertices is written.
void write_faces(const aiMesh& mesh, std::span<const std::uint32_t> number_of,
                 StreamWriter& writer) {
    const auto written = [&](std::uint32_t index) {
        return index < number_of.size() ? number_of[index] : scene_stream::kBadIndex;
    };
    std::vector<std::array<std::uint32_t, 3>> cut;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        const std::span<const std::uint32_t> corners(face.mIndices, face.mNumIndices);
        if (corners.size() < 3)
            continue; // a point or a line
        cut.clear();
        if (std::all_of(corners.begin(), corners.end(),
                        [&](std::uint32_t index) { return index < mesh.mNumVertices; }))
            triangulate(corners, mesh.mVertices, cut);
        else
            cut.resize(corners.size() - 2,
                       {scene_stream::kBadIndex, scene_stream::kBadIndex, scene_stream::kBadIndex});
        for (const auto& [a, b, c] : cut)
            writer.triangle({written(a), written(b), written(c)});
    }
}

void write_mesh(const aiScene& scene, const MeshList& list, const Sizes& sizes,
                StreamWriter& writer) {
    static_assert(sizeof(aiVector3D) == 3 * sizeof(float), "Assimp in single precision");
    std::vector<const aiMesh*> meshes;
    for (const unsigned mesh : list)
        meshes.push_back(scene.mMeshes[mesh]);
    const JoinedVertices joined = join_vertices(meshes);
    writer.begin_mesh(static_cast<std::uint32_t>(joined.positions.size()),
                      static_cast<std::uint32_t>(sizes.triangles));
    writer.positions(reinterpret_cast<const float*>(joined.positions.data()),
                     joined.positions.size());
    std::span<const std::uint32_t> rest = joined.number_of;
    for (const aiMesh* const mesh : meshes) {
        write_faces(*mesh, rest.first(mesh->mNumVertices), writer);
        rest = rest.subspan(mesh->mNumVertices);
    }
}

/// Adds what Assimp does not tell: the name, and whether the object has a material. Assimp names a
/// node "Object_" followed by the object's id.
void complete_3mf_part(const ThreemfModel& model, NodePart& part) {
    constexpr std::string_view kPrefix = "Object_";
    const std::string object =
        part.id.starts_with(kPrefix) ? part.id.substr(kPrefix.size()) : std::string();
    const auto name = model.names.find(object);
    part.name = name == model.names.end() ? std::string() : name->second;
    part.has_material = model.with_material.contains(object);
}

} // namespace

void read_model(const std::string& file, StreamWriter& writer) {
    const std::string extension = lower_extension(file);

    const ThreemfModel model_of_3mf = extension == ".3mf" ? read_3mf_model(file) : ThreemfModel();
    // Never destroyed: the process ends without deleting the scene.
    auto* const importer = new Assimp::Importer;    // NOLINT(cppcoreguidelines-owning-memory)
    importer->SetIOHandler(new OnlyTheModel(file)); // NOLINT: the importer's from now on
    importer->SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    FormatFrame frame;
    // Read first, because Assimp's message about an invalid unit would not name the unit.
    if (extension == ".dae")
        frame = read_collada_frame(file);
    const aiScene& scene = import(*importer, file);

    std::vector<NodePart> parts = assimp_parts(scene);
    double applied = 1; // for COLLADA, Assimp applies the unit to the root
    if (extension == ".fbx") {
        frame = read_fbx_frame(scene, parts);
        applied = frame.unit;
    } else if (extension == ".3mf") {
        frame = model_of_3mf.frame;
        applied = frame.unit;
        for (NodePart& part : parts)
            complete_3mf_part(model_of_3mf, part);
    }
    std::map<MeshList, std::uint32_t> number_of;
    std::vector<const MeshList*> lists;
    std::vector<Sizes> sizes;
    std::vector<std::optional<Colour>> colours;
    for (const NodePart& part : parts) {
        const auto [entry, is_new] =
            number_of.emplace(part.meshes, static_cast<std::uint32_t>(lists.size()));
        if (is_new) {
            lists.push_back(&entry->first);
            sizes.push_back(sizes_of(scene, entry->first));
            colours.push_back(colour_of(scene, entry->first));
        }
    }
    writer.begin(frame, applied, lists.size(), parts.size());
    for (std::size_t i = 0; i < lists.size(); ++i)
        write_mesh(scene, *lists[i], sizes[i], writer);
    for (const NodePart& part : parts) {
        const std::uint32_t mesh = number_of.at(part.meshes);
        writer.part(part.world_from_node, mesh, part.id, part.name, part.type,
                    part.has_material ? colours[mesh] : std::nullopt);
    }
    writer.end();
}

} // namespace abut
