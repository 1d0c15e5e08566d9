#pragma once

#include <abut/camera.h>
#include <abut/model.h>
#include <abut/scene.h>
#include <abut/types.h>
#include <abut/view.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Draws what a View chooses, with OpenGL 3.3. It belongs to the library target Abut::render.
namespace abut {

/// An 8-bit picture: rows from top to bottom, three bytes a pixel.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> pixels;
    friend bool operator==(const Picture&, const Picture&) = default;
};

/// An OpenGL 3.3 core context without a window. It is current on the thread that creates it, until
/// it is destroyed. Several may exist at once.
class OffscreenContext {
public:
    /// Errors      Error{unsupported} if EGL or OpenGL 3.3 is not available.
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Makes the context current on this thread, in place of another one.
    void make_current();

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

/// How a part is drawn. The alpha of colours has no effect.
struct PartState {
    Colour colour{200, 200, 200};
    bool hidden = false;
    bool ghosted = false;     ///< transparent grey, whatever its colour
    bool highlighted = false; ///< with a bright outline
    friend bool operator==(const PartState&, const PartState&) = default;
};

/// A half-space that is cut away: the points with dot(normal, point) > offset, world frame. The
/// inside of solids that it opens is hatched.
struct SectionPlane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

/// Section planes of a picture, beside its section box.
inline constexpr std::size_t kMostSections = 7;

/// A segment or, if both ends are equal, a dot, drawn over the picture. What geometry hides of it
/// is drawn fainter.
struct Mark {
    Vec3 a, b; ///< world
    Colour colour{255, 120, 0};
    float width = 2; ///< pixels; the diameter of a dot
};

/// A horizontal plane with a grid, which fades away from its middle.
struct Ground {
    Vec3 middle;        ///< world
    double reach = 100; ///< where it has faded
};

/// Colours surfaces by a distance: red where it is 0, then orange, yellow and green, to blue at
/// `reach`. What is farther keeps its part's colour.
struct DistanceColours {
    /// Returns the distance of a point (world) on a part's surface. It is called for points of the
    /// picture, from several threads at once, and must not throw.
    std::function<double(std::uint32_t part, const Vec3& point)> distance;
    double reach = 1;
    /// The distance is computed for one pixel in `grid` x `grid`, and for all pixels at borders of
    /// parts. Others are interpolated between points of the same part that are at most a tenth of
    /// the reach away. 1: computed for all pixels.
    std::uint32_t grid = 4;
};
/// The colour of a fraction of the reach, in [0, 1]; for a legend.
Colour distance_colour(double fraction);
/// Returns the colours by the exact distance from the surface of a part, which itself keeps its
/// colour.
///
/// In          part: its number in the renderer.
DistanceColours distances_from(std::uint32_t part, const Model& model,
                               const Transform& world_from_part, double reach);

struct RenderStyle {
    Vec3 up{0, 0, 1};              ///< for the light from the sky, and the ground
    bool edges = true;             ///< dark lines at silhouettes, creases and parts' borders
    bool ambient_occlusion = true; ///< darker corners; costs as much as the geometry in software
    std::optional<Ground> ground;  ///< seen from above only
    /// Samples along each side of a pixel: 1, 2 or 4.
    std::uint32_t samples = 1;
    /// A length of the scene: edges fade where one pixel covers more than a tenth of it, and
    /// occlusion reaches as far. About the size of a common part.
    double detail = 0.5;
    /// Sets whether backs of closed surfaces that the eye is outside of are left out: the inside of
    /// what another part penetrates may then look different. Faster in software. No effect where a
    /// section opens the inside.
    bool leave_out_backs = false;
    /// Sets whether pictures with one sample a pixel and without occlusion are shaded with fewer
    /// steps: normals have 10 bits an axis, and no lines are drawn where a part is before itself.
    /// Faster in software.
    bool quick = false;
    std::vector<SectionPlane> sections; ///< at most kMostSections
    std::optional<Box3> section_box;    ///< what lies outside is cut away
    std::optional<DistanceColours> distances;
    Colour background_low{236, 239, 242}, background_high{171, 189, 208};
};

struct RenderStatistics {
    std::uint64_t triangles = 0, draw_calls = 0; ///< of the last picture
    /// Triangles that were left out of the last picture in software, because others hide them or
    /// they are outside of it.
    std::uint64_t hidden_triangles = 0;
    std::uint64_t chunks = 0, bytes = 0; ///< in vertex and index buffers now
    std::uint64_t uploaded_bytes = 0;    ///< of all pictures
};

/// Returns where a camera sees a point: pixels from the top left corner, and the depth along the
/// viewing direction. None if the point is not in front of the camera.
std::optional<Vec3> on_screen(const Camera& camera, const Vec3& point);

class RendererData;

/// Draws into the current OpenGL 3.3 core context, which must be current in every call and in the
/// destructor. Its state, other than bound framebuffer and viewport, is not preserved.
class Renderer {
public:
    /// In          parts: number of parts; origin: what chunks are relative to (View::origin).
    /// Errors      Error{unsupported} if no context of OpenGL 3.3 is current.
    Renderer(std::size_t parts, const Vec3& origin);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    void set_state(std::uint32_t part, const PartState& state);
    [[nodiscard]] PartState state(std::uint32_t part) const;

    /// Draws a mesh beside the chunks of the view, for example a part that is carried; at most 64
    /// at a time. Returns its number, which `set_state` and `part_at` know.
    ///
    /// Errors      Error{bad_argument} if there are 64.
    std::uint32_t add_part(const Mesh& mesh, const Transform& world_from_mesh,
                           const PartState& state = {});
    void move_part(std::uint32_t part, const Transform& world_from_mesh);
    void remove_part(std::uint32_t part);

    /// Draws a picture into the framebuffer that is bound for drawing, of the camera's size.
    /// Equal to begin, add, end.
    ///
    /// Errors      Error{bad_argument} if the camera or the style is not valid.
    void draw(const ViewFrame& frame, const Camera& camera, const RenderStyle& style,
              std::span<const Mark> marks = {});

    /// Draws a picture in several steps, so that not all of its chunks are in memory at once: add
    /// may be called several times, and chunks may be dropped between the calls.
    void begin(const Camera& camera, const RenderStyle& style);
    void add(const ViewFrame& frame);
    void end(std::span<const Mark> marks = {});

    /// Adds the ghosted parts of a frame. Call it after all calls of `add`, with the same chunks,
    /// as far as they have ghosted parts. `draw` does so by itself.
    void add_ghosts(const ViewFrame& frame);
    [[nodiscard]] bool has_ghosts() const; ///< whether any part is ghosted and not hidden

    /// As `draw`, into a picture in memory.
    Picture picture(const ViewFrame& frame, const Camera& camera, const RenderStyle& style,
                    std::span<const Mark> marks = {});
    /// As `end`, into a picture in memory.
    Picture end_picture(std::span<const Mark> marks = {});

    /// The part that the last picture shows at a pixel, from the top left corner; none for the
    /// background and for ghosts. `end` must have been called. Reads back from the graphics card.
    std::optional<std::uint32_t> part_at(std::uint32_t x, std::uint32_t y);
    /// The number of samples in which each of these parts was visible in the last picture.
    std::vector<std::uint64_t> visible_samples(std::span<const std::uint32_t> parts);

    [[nodiscard]] RenderStatistics statistics() const;

private:
    void add_all(const ViewFrame& frame);

    std::unique_ptr<RendererData> data_;
};

} // namespace abut
