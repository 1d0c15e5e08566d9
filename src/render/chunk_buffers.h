#pragma once

#include <abut/view.h>

#include "render/depth_tiles.h"
#include "render/gl_handle.h"
#include "render/shader_program.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace abut {

/// Where the eye is, relative to the origin of chunks, and how far the nearest visible point is.
struct EyePoint {
    std::array<double, 3> at{};
    double near = 0;
};

/// The chunks and triangles that need not be drawn.
struct SkippedTriangles {
    /// If given, the backs of closed surfaces that do not hold the eye.
    const EyePoint* backs_seen_from = nullptr;
    /// If given, chunks that are hidden; not those with instances.
    const DepthTiles* behind = nullptr;
};

/// The chunks on the graphics card, and their draw calls.
class ChunkBuffers {
public:
    /// Takes the uploads and the drops of a frame, and its instances.
    void update(const ViewFrame& frame);

    /// Draws the chunks of a frame without instances, or with them. The program must be in use.
    void draw(const ViewFrame& frame, bool instanced, ShaderProgram& program,
              const SkippedTriangles& left_out = {});

    [[nodiscard]] std::uint64_t chunks() const { return chunks_.size(); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint64_t draw_calls() const { return draw_calls_; }
    [[nodiscard]] std::uint64_t hidden_chunks() const { return hidden_chunks_; }
    [[nodiscard]] std::uint64_t hidden_triangles() const { return hidden_triangles_; }
    /// Triangles of a chunk; 0 if it is not there.
    [[nodiscard]] std::uint64_t triangles_of(std::uint32_t chunk) const;
    void reset_counts() { triangles_ = draw_calls_ = hidden_chunks_ = hidden_triangles_ = 0; }

private:
    struct Chunk {
        GlVertexArray array;
        GlBuffer vertices, indices;
        GLsizei index_count = 0, closed_count = 0; ///< closed: the first indices, see ViewChunk
        std::array<float, 3> lower{}, step{};
        std::array<double, 3> box_lower{}, box_upper{};
        std::uint64_t bytes = 0;
    };

    void upload(std::uint32_t number, const ViewChunk& data);
    void bind_instances(std::uint32_t first) const;
    /// True if the eye sees closed surfaces of the chunk from outside only.
    static bool is_outside(const Chunk& chunk, std::span<const ChunkInstance> instances,
                           const EyePoint& eye);

    std::unordered_map<std::uint32_t, Chunk> chunks_;
    GlBuffer instances_;
    std::uint64_t bytes_ = 0, uploaded_bytes_ = 0, triangles_ = 0, draw_calls_ = 0;
    std::uint64_t hidden_chunks_ = 0, hidden_triangles_ = 0;
};

} // namespace abut
