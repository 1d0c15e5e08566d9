#include "render/extra_parts.h"

#include <abut/error.h>

#include "math/rounding.h"
#include "math/transform.h"
#include "view/levels/level_tree.h"

#include <algorithm>

namespace abut {

std::array<float, 12> rows_of(const Transform& t) {
    std::array<float, 12> rows{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            rows.at(row * 4 + column) = to_float(t.m.at(column * 3 + row));
    return rows;
}

ExtraParts::Extra& ExtraParts::extra(std::uint32_t part) {
    const auto found = parts_.find(part);
    if (found == parts_.end())
        throw Error(ErrorCode::bad_argument, "the renderer has no such part");
    return found->second;
}

std::uint32_t ExtraParts::add(const Mesh& mesh, const Transform& world_from_mesh) {
    std::uint32_t part = first_;
    while (parts_.contains(part))
        ++part;
    if (part - first_ >= kMost)
        throw Error(ErrorCode::bad_argument, "the renderer draws at most 64 parts of its own");
    Extra made;
    for (ViewChunk& chunk : make_chunks(mesh, Transform(), 0)) {
        made.chunks.push_back(next_chunk_);
        uploads_.push_back({next_chunk_++, std::make_shared<ViewChunk>(std::move(chunk))});
    }
    parts_.emplace(part, std::move(made));
    move(part, world_from_mesh);
    return part;
}

void ExtraParts::move(std::uint32_t part, const Transform& world_from_mesh) {
    extra(part).placed = {rows_of(translated(world_from_mesh, -origin_)), part};
}

void ExtraParts::remove(std::uint32_t part) {
    const Extra& gone = extra(part);
    drops_.insert(drops_.end(), gone.chunks.begin(), gone.chunks.end());
    std::erase_if(uploads_, [&](const ChunkUpload& each) {
        return std::find(gone.chunks.begin(), gone.chunks.end(), each.chunk) != gone.chunks.end();
    });
    parts_.erase(part);
}

void ExtraParts::update() {
    draws_.clear();
    instances_.clear();
    for (const auto& [part, each] : parts_) {
        for (const std::uint32_t chunk : each.chunks)
            draws_.push_back({chunk, static_cast<std::uint32_t>(instances_.size()), 1});
        instances_.push_back(each.placed);
    }
    ViewFrame frame;
    frame.uploads = uploads_;
    frame.drops = drops_;
    frame.instances = instances_;
    buffers_.update(frame);
    uploads_.clear();
    drops_.clear();
}

void ExtraParts::draw(ShaderProgram& program) {
    ViewFrame frame;
    frame.draws = draws_;
    frame.instances = instances_;
    buffers_.draw_instances(frame, program, {});
}

} // namespace abut
