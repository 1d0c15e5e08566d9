#pragma once

#include <abut/view.h>

#include "render/gl_handle.h"
#include "render/shader_program.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace abut {

/// The chunks on the graphics card, and their draw calls.
class ChunkBuffers {
public:
    /// Takes the uploads and the drops of a frame, and its instances.
    void update(const ViewFrame& frame);

    /// Draws the chunks of a frame without instances, or with them. The program must be in use.
    void draw(const ViewFrame& frame, bool instanced, ShaderProgram& program);

    [[nodiscard]] std::uint64_t chunks() const { return chunks_.size(); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint64_t draw_calls() const { return draw_calls_; }
    void reset_counts() { triangles_ = draw_calls_ = 0; }

private:
    struct Chunk {
        GlVertexArray array;
        GlBuffer vertices, indices;
        GLsizei index_count = 0;
        std::array<float, 3> lower{}, step{};
        std::uint64_t bytes = 0;
    };

    void upload(std::uint32_t number, const ViewChunk& data);
    void bind_instances(std::uint32_t first) const;

    std::unordered_map<std::uint32_t, Chunk> chunks_;
    GlBuffer instances_;
    std::uint64_t bytes_ = 0, uploaded_bytes_ = 0, triangles_ = 0, draw_calls_ = 0;
};

} // namespace abut
