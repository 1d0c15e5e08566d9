#pragma once

#include <abut/mesh.h>
#include <abut/view.h>

#include "render/chunk_buffers.h"

#include <cstdint>
#include <map>
#include <vector>

namespace abut {

/// The rows of a transform as an instance has them.
std::array<float, 12> rows_of(const Transform& t);

/// Parts that are drawn beside those of the view, each with a transform of its own.
class ExtraParts {
public:
    static constexpr std::uint32_t kMost = 64;

    /// In          first: number of the first such part; origin: what chunks are relative to.
    ExtraParts(std::uint32_t first, const Vec3& origin) : first_(first), origin_(origin) {}

    std::uint32_t add(const Mesh& mesh, const Transform& world_from_mesh);
    void move(std::uint32_t part, const Transform& world_from_mesh);
    void remove(std::uint32_t part);

    [[nodiscard]] bool empty() const { return parts_.empty(); }
    /// Sends what has changed.
    void update();
    void draw(ShaderProgram& program);

private:
    struct Extra {
        std::vector<std::uint32_t> chunks;
        ChunkInstance placed;
    };
    Extra& extra(std::uint32_t part);

    std::uint32_t first_;
    Vec3 origin_;
    std::map<std::uint32_t, Extra> parts_; ///< by number
    ChunkBuffers buffers_;
    std::uint32_t next_chunk_ = 0;
    std::vector<ChunkUpload> uploads_; ///< since the last update
    std::vector<std::uint32_t> drops_;
    std::vector<ChunkDraw> draws_;
    std::vector<ChunkInstance> instances_;
};

} // namespace abut
