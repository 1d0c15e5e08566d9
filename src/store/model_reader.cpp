#include "store/model_reader.h"

#include <abut/error.h>

#include "rigid/model/model_data.h"
#include "store/codec/hierarchy_codec.h"

#include <memory>
#include <optional>
#include <utility>

namespace abut {

ModelReader::ModelReader(StoreFile& store, std::uint64_t room)
    : store_(store), room_(room), are_kept_(store.with_connection(has_hierarchies)) {}

Model ModelReader::read_mesh(std::int64_t mesh) {
    const MeshRow row = store_.mesh(mesh);
    if (row.blocks != 1)
        return Model(store_.read_mesh(mesh)); // a large mesh has no stored hierarchy
    StoredBlockData block = store_.read_block_and_row(row.first_block);
    return model_of(block.row, store_.whole_mesh(row, std::move(block.block)));
}

ModelBlock ModelReader::read_block(std::int64_t block) {
    StoredBlockData read = store_.read_block_and_row(block);
    return {model_of(read.row, std::move(read.block.mesh)), std::move(read.block.triangle_ids)};
}

Model ModelReader::model_of(const BlockRow& row, Mesh mesh) {
    if (are_kept_)
        if (const auto kept = store_.find_hierarchy(row))
            if (const auto outline = decode_hierarchy(kept->data, mesh.triangles.size())) {
                ++found_;
                return Model(std::make_shared<const ModelData>(std::move(mesh), *outline));
            }
    Model model(std::move(mesh));
    if (room_ == 0)
        return model;
    HierarchyRow built{row.block, row.data_checksum, encode_hierarchy(model.data().outline())};
    const std::uint64_t bytes = sizeof built + built.data.size();
    const std::scoped_lock lock(mutex_);
    if (built_bytes_ + bytes <= room_) {
        built_bytes_ += bytes;
        built_.push_back(std::move(built));
    }
    return model;
}

std::vector<HierarchyRow> ModelReader::take_built() {
    const std::scoped_lock lock(mutex_);
    built_bytes_ = 0;
    if (!built_.empty())
        are_kept_ = true;
    return std::exchange(built_, {});
}

} // namespace abut
