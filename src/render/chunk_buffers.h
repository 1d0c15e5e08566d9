#pragma once

#include <abut/view.h>

#include "render/depth_tiles.h"
#include "render/gl_handle.h"
#include "render/shader_program.h"
#include "render/triangle_runs.h"
#include "view/selection/frustum.h"

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut {

/// Where the eye is, relative to the origin of chunks, and how far the nearest visible point is.
struct EyePoint {
    std::array<double, 3> at{};
    double near = 0;
};

/// The triangles that need not be drawn.
struct SkippedTriangles {
    /// If given, the backs of closed surfaces that do not hold the eye.
    const EyePoint* backs_seen_from = nullptr;
    // The others are of chunks without instances.
    const Frustum* outside_of = nullptr; ///< if given, runs outside of it
    const DepthTiles* behind = nullptr;  ///< if given, runs that are hidden
};

/// A run of triangles that was not drawn, as it may be hidden.
struct HiddenRun {
    std::uint32_t chunk = 0;
    std::uint32_t run = 0; ///< in the chunk's runs
};

/// The chunks on the graphics card, and their draw calls.
class ChunkBuffers {
public:
    /// In          in_software: whether other threads of this machine rasterise.
    explicit ChunkBuffers(bool in_software = false) : in_software_(in_software) {}

    /// Takes the uploads and the drops of a frame, and its instances.
    void update(const ViewFrame& frame);

    // The program must be in use.
    /// Draws the chunks of a frame that have no instances.
    ///
    /// In/out      hidden: takes the runs that are behind; if null, they count as left out.
    void draw(const ViewFrame& frame, ShaderProgram& program, const SkippedTriangles& left_out,
              std::vector<HiddenRun>* hidden = nullptr);
    /// Draws what is not behind of runs that were hidden before.
    void draw(std::span<const HiddenRun> runs, ShaderProgram& program,
              const SkippedTriangles& left_out);
    /// Draws the chunks of a frame that have instances.
    void draw_instances(const ViewFrame& frame, ShaderProgram& program,
                        const SkippedTriangles& left_out);

    [[nodiscard]] std::uint64_t chunks() const { return chunks_.size(); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint64_t draw_calls() const { return draw_calls_; }
    /// Triangles of this picture's chunks that are hidden, or outside of it.
    [[nodiscard]] std::uint64_t left_out_triangles() const { return left_out_triangles_; }
    /// Triangles of a chunk; 0 if it is not there.
    [[nodiscard]] std::uint64_t triangles_of(std::uint32_t chunk) const;
    void reset_counts() { triangles_ = draw_calls_ = left_out_triangles_ = waiting_ = 0; }

private:
    struct Chunk {
        GlVertexArray array;
        GlBuffer vertices, indices;
        GLsizei index_count = 0, closed_count = 0; ///< closed: the first indices, see ViewChunk
        std::array<float, 3> lower{}, step{};
        std::array<float, 3> lower_corner{}, upper_corner{}; ///< of its box
        std::vector<TriangleRun> runs;
        std::uint64_t bytes = 0;
    };

    /// Ranges of indices to draw. Neighbours are joined.
    struct Ranges {
        void add(std::uint32_t first, std::uint32_t end);
        void clear();
        std::vector<GLsizei> counts;
        std::vector<const void*> offsets;

    private:
        std::uint32_t end_ = 0; ///< of the last range
    };

    void upload(std::uint32_t number, const ViewChunk& data);
    void bind_instances(std::uint32_t first) const;
    /// True if the eye sees closed surfaces of the chunk from outside only.
    static bool is_outside(const Chunk& chunk, std::span<const ChunkInstance> instances,
                           const EyePoint& eye);

    static std::uint32_t closed_indices(const Chunk& chunk,
                                        std::span<const ChunkInstance> instances,
                                        const SkippedTriangles& left_out);
    void list_runs(std::uint32_t number, const Chunk& chunk, std::uint32_t closed,
                   const SkippedTriangles& left_out, std::vector<HiddenRun>* hidden);
    void draw_ranges(const Chunk& chunk, ShaderProgram& program);
    void count_triangles(std::uint64_t count);

    bool in_software_;
    std::unordered_map<std::uint32_t, Chunk> chunks_;
    Ranges closed_, open_; ///< of the chunk that is drawn next
    GlBuffer instances_;
    std::uint64_t bytes_ = 0, uploaded_bytes_ = 0, triangles_ = 0, draw_calls_ = 0;
    std::uint64_t left_out_triangles_ = 0;
    std::uint64_t waiting_ = 0; ///< triangles since the last flush
};

} // namespace abut
