#include "massive/stored_parts.h"

#include <abut/error.h>

#include "massive/clash_identity.h"
#include "massive/rule_match.h"
#include "math/vector.h"
#include "rigid/model_data.h"
#include "store/row_hash.h"
#include "volume/aabb.h"

#include <algorithm>
#include <numeric>

namespace abut {

StoredParts gather_parts(StoreFile& store, bool with_names) {
    StoredParts result;
    store.for_each_mesh([&](const MeshRow& mesh) {
        result.meshes.push_back(
            {mesh.mesh, most_model_bytes(mesh.triangles, mesh.vertices), mesh.stored_bytes});
    });
    result.models = store.models();
    std::uint64_t parts = 0;
    for (const ModelRow& model : result.models) {
        if (model.importing)
            throw Error(ErrorCode::bad_argument, store.path(),
                        "is incomplete: the import of " + model.file + " has not ended");
        parts += model.parts;
    }
    result.parts.reserve(parts);
    for (std::uint32_t m = 0; m < result.models.size(); ++m) {
        Scene& scene = result.scenes.emplace_back();
        scene.file = result.models[m].file;
        store.for_each_part(result.models[m], [&](const PartRow& part) {
            // Meshes come in the order of their numbers.
            const auto mesh =
                std::ranges::lower_bound(result.meshes, part.mesh, {}, &StoredMesh::mesh);
            if (mesh == result.meshes.end() || mesh->mesh != part.mesh)
                throw Error(ErrorCode::malformed, store.path(),
                            "is damaged: part " + part.id + " shows a mesh that is missing");
            result.parts.push_back(
                {part.box, part.part, static_cast<std::uint32_t>(mesh - result.meshes.begin()), m,
                 static_cast<std::uint32_t>(part.number),
                 static_cast<std::uint32_t>(
                     std::min<std::uint64_t>(part.generation, kLastGeneration))});
            if (with_names)
                scene.parts.push_back({part.id, part.name, part.type, 0, {}});
        });
    }
    return result;
}

Hash128 parts_key(const std::vector<ModelRow>& models) {
    RowHash hash;
    for (const ModelRow& model : models)
        hash.add(model.model).add(model.file).add(model.parts).add(model.parts_sum);
    return hash.value_128();
}

void require_parts(const std::vector<ModelRow>& models, const Hash128& key,
                   const std::string& store) {
    if (parts_key(models) != key || std::ranges::any_of(models, &ModelRow::importing))
        throw Error(ErrorCode::unreadable, store,
                    "has been changed by an import while the job was under way: run it again");
}

PartsByRow::PartsByRow(const StoredParts& stored)
    : parts_(stored.parts), order_(stored.parts.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return parts_[i].row; });
}

std::optional<std::uint32_t> PartsByRow::find(std::int64_t row) const {
    const auto at =
        std::ranges::lower_bound(order_, row, {}, [&](std::uint32_t i) { return parts_[i].row; });
    if (at == order_.end() || parts_[*at].row != row)
        return std::nullopt;
    return *at;
}

std::vector<IndexPair> find_candidates(const StoredParts& stored, const ClashOptions& options) {
    std::vector<Box3> boxes;
    boxes.reserve(stored.parts.size());
    for (const StoredPart& part : stored.parts)
        boxes.push_back(part.box);
    const bool across = stored.models.size() > 1 && !options.self;
    const auto wanted = [&](std::uint32_t i, std::uint32_t j) {
        return !across || stored.parts[i].model != stored.parts[j].model;
    };
    std::vector<IndexPair> pairs = overlapping_boxes(boxes, largest_clearance(options), wanted);
    if (options.rules.empty())
        return pairs;
    const auto out_of_reach = [&](const IndexPair& pair) {
        const StoredPart &a = stored.parts[pair.a()], &b = stored.parts[pair.b()];
        const Scene &model_a = stored.scenes[a.model], &model_b = stored.scenes[b.model];
        const auto terms =
            terms_of(options, model_a, model_a.parts[a.number], model_b, model_b.parts[b.number]);
        return !terms || !overlap(a.box, b.box, terms->clearance);
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), out_of_reach), pairs.end());
    return pairs;
}

} // namespace abut
