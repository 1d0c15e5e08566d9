#pragma once

#include <abut/camera.h>
#include <abut/store.h>
#include <abut/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What a renderer draws of a store that does not fit into memory: in each frame a set of chunks of
/// geometry, each at the coarsest level of detail whose error does not show. No graphics library is
/// used here; abut/renderer.h draws with OpenGL.
namespace abut {

/// A vertex of a chunk: 12 bytes, for a vertex buffer.
struct ChunkVertex {
    /// Along each axis the position is `lower + step * position`, of the ViewChunk.
    std::array<std::uint16_t, 3> position{};
    /// Unit normal as an octahedral map, each coordinate in [-127, 127].
    std::array<std::int8_t, 2> normal{};
    /// The part, as an index in View::parts(). In a chunk of an instanced mesh it is 0: each
    /// instance states its part.
    std::uint32_t part = 0;
    friend bool operator==(const ChunkVertex&, const ChunkVertex&) = default;
};
static_assert(sizeof(ChunkVertex) == 12);

/// A piece of geometry that is loaded and drawn at once.
struct ViewChunk {
    /// Frame of an instanced mesh, or world minus View::origin().
    std::array<float, 3> lower{}, step{};
    std::vector<ChunkVertex> vertices;  ///< at most 65,536
    std::vector<std::uint16_t> indices; ///< three for each triangle
    /// The first triangles belong to closed surfaces whose fronts are outside: an eye outside of
    /// their box sees a front at every pixel where it could see a back.
    std::uint32_t closed_triangles = 0;
};

/// A part that shows a shared mesh. `rows` are the three rows of the matrix from the
/// mesh to world minus View::origin().
struct ChunkInstance {
    std::array<float, 12> rows{};
    std::uint32_t part = 0;
};

/// A draw call. Without instances, the chunk is drawn once, in world minus origin.
struct ChunkDraw {
    std::uint32_t chunk = 0;
    std::uint32_t first_instance = 0, instances = 0; ///< in ViewFrame::instances
};

/// A chunk that the renderer must have from this frame on.
struct ChunkUpload {
    std::uint32_t chunk = 0;
    std::shared_ptr<const ViewChunk> data;
};

struct ViewStatistics {
    std::uint64_t triangles = 0, draw_calls = 0; ///< of the last frame
    std::uint64_t wanted = 0, missing = 0;       ///< chunks of the last cut; those not in memory
    std::uint64_t lookups = 0, misses = 0;       ///< the same, of all frames
    std::uint64_t culled_by_frustum = 0, culled_by_occlusion = 0; ///< nodes, of the last frame
    std::uint64_t bytes_loaded = 0;                               ///< of all frames
    std::uint64_t bytes = 0, peak_bytes = 0;         ///< in CPU memory; at most ViewOptions::memory
    std::uint64_t gpu_bytes = 0, peak_gpu_bytes = 0; ///< at most ViewOptions::gpu_memory
    double seconds_selecting = 0;                    ///< of the last frame
};

/// What to draw. Valid until the next call of View::frame.
struct ViewFrame {
    std::span<const std::uint32_t> drops; ///< chunks that are no longer needed; first of all
    std::span<const ChunkUpload> uploads; ///< after the drops, before drawing
    std::span<const ChunkDraw> draws;     ///< nearest first
    std::span<const ChunkInstance> instances;
    /// Whether every chunk is at the level that the pixel error asks for.
    bool complete = false;
    /// Whether nothing that this frame wanted is missing, except what cannot be read. The same
    /// camera then gives the same draws again. True also where a budget keeps the picture coarse.
    bool loaded = false;
    double pixel_error = 0; ///< the largest error of what is drawn, in pixels
};

struct ViewOptions {
    /// Bytes of CPU memory for the tree of levels and for chunks on their way to the renderer.
    std::uint64_t memory = std::uint64_t{256} << 20;
    /// Bytes of the renderer's vertex and index buffers.
    std::uint64_t gpu_memory = std::uint64_t{512} << 20;
    /// Largest error in pixels; more if the budgets demand it. A point and its stand-in lie in a
    /// ball whose image is at most as wide.
    double pixel_error = 1;
    std::uint64_t triangle_budget = 500'000;
    std::uint32_t draw_budget = 1'500;
    /// Bytes of chunks that one frame hands to the renderer, or one chunk. A frame after `wait`, and
    /// every frame without `background`, has no such limit.
    std::uint64_t upload_budget = std::uint64_t{4} << 20;
    double look_ahead = 1;  ///< seconds of the predicted path for which chunks are read ahead
    bool background = true; ///< whether a second thread reads; otherwise `frame` waits for the disk
};

/// A part of a view: its row in the store's table `part`.
struct ViewPart {
    std::int64_t number = 0;
    std::string file, id, name, type;
    Box3 box;                     ///< world
    std::optional<Colour> colour; ///< as Part::colour
};

/// An answer of View::find_parts.
struct FoundParts {
    std::vector<std::uint32_t> parts; ///< indices in View::parts(), ascending
    /// Where to go on: the first part that was not compared. The number of parts if all were.
    std::uint32_t next = 0;
};

class ViewData;

/// Chooses and loads what a renderer draws.
///
/// Only one thread at a time may use a view.
class View {
public:
    /// Errors      as open_store; Error{bad_argument} if the store has no current levels (see
    ///             build_levels), or if the memory does not hold the tree of levels.
    explicit View(const Store& store, const ViewOptions& options = {});
    ~View();
    View(View&&) noexcept;
    View& operator=(View&&) noexcept;

    /// Chooses what to draw. With ViewOptions::background it never waits for the disk: a second
    /// thread reads what is missing, and a coarser level stands for it until then. Without, it
    /// reads all that the frame wants and the memory holds, before it returns.
    ///
    /// In          velocity: of the eye, in units a second, for loading ahead.
    /// Errors      Error{bad_argument} if the camera is not valid; Error{malformed} if a chunk that
    ///             was read is damaged.
    /// Cost        O(n log n) of the n chunks and instances drawn and those that they replace,
    ///             whatever the size of the store. With ViewOptions::background at most
    ///             ViewOptions::upload_budget of chunks change hands; without, reading takes as
    ///             long as the disk takes.
    const ViewFrame& frame(const Camera& camera, const Vec3& velocity = {});
    /// Waits until all that the last frame wanted is loaded, or memory is full; without
    /// ViewOptions::background there is nothing to wait for. The next frame
    /// shows it. If a chunk cannot be read, it returns at once and the next frame throws the Error.
    void wait();

    /// A point in the middle of the model; chunks are relative to it.
    [[nodiscard]] Vec3 origin() const;
    [[nodiscard]] Box3 bounds() const; ///< world
    [[nodiscard]] UpAxis up() const;
    /// Rows of the store's table `part`, ascending. ChunkVertex::part is an index in it.
    [[nodiscard]] std::span<const std::int64_t> parts() const;
    /// The index in parts() of a row; none if there is no such part.
    [[nodiscard]] std::optional<std::uint32_t> index_of(std::int64_t number) const;
    /// Reads the row of a part.
    ///
    /// Errors      Error{bad_argument} if there is no such part; those of the store.
    [[nodiscard]] ViewPart part(std::uint32_t index) const;
    /// Finds parts whose id, name or type contains a text; capital letters of the Latin alphabet
    /// count as small ones. It ends after `most` parts, or when the time is used up. The caller may
    /// go on with FoundParts::next, for example in the next frame.
    ///
    /// In          from: the first part to compare, as an index in parts().
    /// Errors      those of the store.
    [[nodiscard]] FoundParts find_parts(const std::string& text, std::size_t most,
                                        std::uint32_t from = 0, double seconds = 0.01) const;
    /// Leaves parts out of the picture (carried away, or hidden), or brings them back. Those of a
    /// merged chunk are still in it: the renderer hides them by their index.
    void set_hidden(std::uint32_t part, bool hidden);
    /// Sets whether parts that others hide are left out; at first they are. Turn it off while the
    /// renderer cuts parts away or makes them transparent, other than by set_hidden.
    void set_occlusion(bool on);
    /// Changes ViewOptions::triangle_budget and draw_budget from the next frame on: fewer while the
    /// eye moves and a frame takes long, more when it rests.
    void set_budgets(std::uint64_t triangles, std::uint32_t draws);
    [[nodiscard]] const ViewStatistics& statistics() const;

private:
    std::unique_ptr<ViewData> data_;
};

} // namespace abut
