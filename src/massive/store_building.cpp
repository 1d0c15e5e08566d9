#include "massive/store_building.h"

#include <abut/error.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace abut {

namespace {

constexpr std::uint32_t kMissing = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void throw_changed(const StoreFile& store) {
    throw Error(ErrorCode::unreadable, store.path(),
                "has been changed by an import since the job: run it again");
}

} // namespace

StoreBuilding::StoreBuilding(const StoreClashReport& found, StoreFile& store) : store_(store) {
    gather_meshes();
    const std::vector<ModelRow> models = store.models();
    if (models.size() != found.models.size())
        throw_changed(store);
    for (std::uint32_t m = 0; m < models.size(); ++m)
        gather_parts_of(m, models[m], found.models[m].parts);
}

void StoreBuilding::gather_meshes() {
    store_.for_each_mesh([&](const MeshRow& row) {
        mesh_rows_.push_back(row.mesh);
        meshes_.push_back({row.triangles, row.box});
    });
}

void StoreBuilding::gather_parts_of(std::uint32_t model, const ModelRow& row,
                                    const std::vector<Part>& clashing) {
    std::unordered_map<std::string_view, std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < clashing.size(); ++i)
        wanted.emplace(clashing[i].id, i);
    std::vector<std::uint32_t>& places = of_report_.emplace_back(clashing.size(), kMissing);
    store_.for_each_part(row, [&](const PartRow& part) {
        const auto mesh = std::ranges::lower_bound(mesh_rows_, part.mesh);
        if (mesh == mesh_rows_.end() || *mesh != part.mesh)
            throw Error(ErrorCode::malformed, store_.path(),
                        "is damaged: part " + part.id + " shows a mesh that is missing");
        if (const auto at = wanted.find(part.id); at != wanted.end())
            places[at->second] = static_cast<std::uint32_t>(parts_.size());
        parts_.push_back({part.box, model, static_cast<std::uint32_t>(mesh - mesh_rows_.begin())});
        part_rows_.push_back(part.part);
    });
    if (std::ranges::find(places, kMissing) != places.end())
        throw_changed(store_);
}

std::uint32_t StoreBuilding::part_of_report(std::uint32_t model, std::uint32_t part) const {
    return of_report_[model][part];
}

Transform StoreBuilding::world_from_mesh(std::uint32_t part) const {
    return store_.part(part_rows_[part]).world_from_mesh;
}

void StoreBuilding::for_each_piece(std::uint32_t mesh,
                                   const std::function<void(const Mesh&)>& take) const {
    const MeshRow row = store_.mesh(mesh_rows_[mesh]);
    if (row.blocks == 1)
        return take(store_.read_mesh(row.mesh));
    for (const BlockRow& block : store_.blocks(row))
        take(store_.read_block(block.block).mesh);
}

} // namespace abut
