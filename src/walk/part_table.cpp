#include "walk/part_table.h"

#include <abut/error.h>

#include "rigid/model/model_data.h"
#include "world/narrow_phase/body.h"

#include <algorithm>
#include <unordered_map>

namespace abut {

namespace {

struct StoredMeshChunks {
    std::int64_t mesh = 0;
    std::uint32_t first_chunk = 0, chunks = 0;
};

/// The meshes of a store and their stored chunks, sorted by mesh number.
class MeshChunks {
public:
    explicit MeshChunks(StoreFile& store) {
        std::vector<MeshRow> cut;
        store.for_each_mesh([&](const MeshRow& mesh) {
            meshes_.push_back({mesh.mesh, static_cast<std::uint32_t>(chunks.size()),
                               static_cast<std::uint32_t>(mesh.blocks)});
            if (mesh.blocks != 1) {
                cut.push_back(mesh);
                chunks.resize(chunks.size() + mesh.blocks);
            } else {
                chunks.push_back({mesh.mesh, bytes_of(mesh.triangles, mesh.vertices), false});
            }
        });
        for (const MeshRow& mesh : cut) {
            std::uint32_t chunk = of(mesh.mesh, store).first_chunk;
            for (const BlockRow& block : store.blocks(mesh)) {
                // Some blocks hold vertices only.
                if (block.triangles > 0)
                    boxes.emplace(chunk, block.box);
                chunks[chunk++] = {block.block, bytes_of(block.triangles, block.vertices), true};
            }
        }
    }

    [[nodiscard]] const StoredMeshChunks& of(std::int64_t mesh, const StoreFile& store) const {
        const auto at = std::ranges::lower_bound(meshes_, mesh, {}, &StoredMeshChunks::mesh);
        if (at == meshes_.end() || at->mesh != mesh)
            throw Error(ErrorCode::malformed, store.path(),
                        "is damaged: a part shows mesh " + std::to_string(mesh) +
                            ", which is missing");
        return *at;
    }

    std::vector<StoredChunk> chunks;
    std::unordered_map<std::uint32_t, Box3> boxes; ///< of mesh blocks, in the mesh's frame

private:
    static std::uint32_t bytes_of(std::uint64_t triangles, std::uint64_t vertices) {
        return static_cast<std::uint32_t>(most_model_bytes(triangles, vertices));
    }

    std::vector<StoredMeshChunks> meshes_;
};

template <typename Value>
std::vector<Value> permuted(const std::vector<Value>& values,
                            const std::vector<std::uint32_t>& order) {
    std::vector<Value> result;
    result.reserve(order.size());
    for (const std::uint32_t i : order)
        result.push_back(values[i]);
    return result;
}

} // namespace

PartTable::PartTable(StoreFile& store) {
    MeshChunks meshes(store);
    std::vector<Aabb> boxes;
    const std::vector<ModelRow> models = store.models();
    std::uint64_t parts = 0;
    for (const ModelRow& model : models) {
        if (model.importing)
            throw Error(ErrorCode::bad_argument, store.path(),
                        "is incomplete: the import of " + model.file + " has not ended");
        parts += model.parts;
    }
    boxes.reserve(parts), rows_.reserve(parts), chunks_of_.reserve(parts);
    const auto add = [&](const PartRow& part, std::uint32_t chunk, const Box3& box) {
        if (rows_.empty())
            middle_ = 0.5 * box.lower + 0.5 * box.upper;
        boxes.push_back(narrow(box));
        rows_.push_back(part.part);
        chunks_of_.push_back(chunk);
    };
    for (const ModelRow& model : models)
        store.for_each_part(model, [&](const PartRow& part) {
            const StoredMeshChunks& mesh = meshes.of(part.mesh, store);
            if (is_empty(part.box))
                return;
            if (mesh.chunks == 1) {
                add(part, mesh.first_chunk, part.box);
                return;
            }
            for (std::uint32_t chunk = mesh.first_chunk; chunk < mesh.first_chunk + mesh.chunks;
                 ++chunk)
                if (const auto box = meshes.boxes.find(chunk); box != meshes.boxes.end())
                    add(part, chunk, placed_bounds(box->second, part.world_from_mesh));
        });
    chunks_ = std::move(meshes.chunks);
    const std::vector<std::uint32_t> order = tree_.build(boxes);
    rows_ = permuted(rows_, order);
    chunks_of_ = permuted(chunks_of_, order);
    by_row_.resize(rows_.size());
    for (std::uint32_t entry = 0; entry < size(); ++entry)
        by_row_[entry] = entry;
    std::sort(by_row_.begin(), by_row_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return rows_[a] != rows_[b] ? rows_[a] < rows_[b] : a < b;
    });
}

std::span<const std::uint32_t> PartTable::entries(std::int64_t row) const {
    const auto first = std::partition_point(by_row_.begin(), by_row_.end(),
                                            [&](std::uint32_t e) { return rows_[e] < row; });
    const auto last = std::partition_point(first, by_row_.end(),
                                           [&](std::uint32_t e) { return rows_[e] == row; });
    return {first, last};
}

std::uint64_t PartTable::largest_chunk() const {
    std::uint64_t largest = 0;
    for (const StoredChunk& chunk : chunks_)
        largest = std::max<std::uint64_t>(largest, chunk.bytes);
    return largest;
}

std::size_t PartTable::bytes() const {
    return tree_.bytes() + rows_.capacity() * sizeof(rows_[0]) +
           chunks_of_.capacity() * sizeof(chunks_of_[0]) + by_row_.capacity() * sizeof(by_row_[0]) +
           chunks_.capacity() * sizeof(chunks_[0]);
}

Aabb PartTable::narrow(const Box3& box) const {
    // The box is enlarged by the rounding error of the subtraction.
    const double size = max_abs(box.lower) + max_abs(box.upper) + max_abs(middle_);
    return Aabb({box.lower - middle_, box.upper - middle_}, 0x1p-52 * size);
}

} // namespace abut
