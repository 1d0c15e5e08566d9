#pragma once

#include <abut/renderer.h>

#include "render/chunk_buffers.h"
#include "render/distance_layer.h"
#include "render/drawn_camera.h"
#include "render/extra_parts.h"
#include "render/frame_targets.h"
#include "render/mark_layer.h"
#include "render/part_states.h"
#include "render/shader_program.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// What a Renderer keeps, and the passes of a picture in their order: opaque parts, ground, ghosts,
/// occlusion, colours, samples to pixels, marks.
class RendererData {
public:
    RendererData(std::size_t parts, const Vec3& origin);

    void begin(const Camera& camera, const RenderStyle& style);
    void draw_chunks(const ViewFrame& frame);
    void draw_ghosts(const ViewFrame& frame);
    /// Finishes the picture in a framebuffer of its size.
    void finish(GLuint framebuffer, std::span<const Mark> marks);

    PartStates states;
    ChunkBuffers chunks;
    ExtraParts extra;
    FrameTargets targets;
    std::optional<DrawnCamera> camera; ///< of the last picture
    RenderStyle style;
    bool is_open = false; ///< between begin and end
    GLuint target = 0;    ///< the framebuffer that was bound at begin

private:
    enum class Pass : std::uint8_t { parts, ghosts, ground };

    ShaderProgram& program(const std::string& name, const std::string& definitions,
                           const char* vertex, const char* fragment);
    ShaderProgram& geometry(Pass pass, bool instanced);
    void set_sections(ShaderProgram& program) const;
    /// Draws all chunks of a frame.
    void draw_all(const ViewFrame& frame, Pass pass);
    /// Draws what the last picture did not hide, and then what this one does not hide of the rest.
    void draw_in_steps(const ViewFrame& frame);
    [[nodiscard]] EyePoint eye_point() const;
    /// Normals have 10 bits an axis then, which occlusion does not know.
    [[nodiscard]] bool is_quick() const {
        return style.quick && style.samples == 1 && !style.ambient_occlusion;
    }
    [[nodiscard]] bool leaves_out_backs() const { return style.leave_out_backs && !is_cut(); }
    void draw_extra(Pass pass);
    void draw_ground();
    void draw_occlusion();
    void compute_distances();
    void shade();
    void set_view(ShaderProgram& program) const;
    void to_pixels(GLuint framebuffer);
    [[nodiscard]] bool is_cut() const { return !style.sections.empty() || style.section_box; }
    [[nodiscard]] std::array<float, 3> depth_to_w() const;

    Vec3 origin_;
    bool in_software_; ///< whether there is no graphics card
    bool reversed_;    ///< whether depth is reversed, which keeps its precision far away
    bool has_ground_ = false, has_ghosts_ = false; ///< in the buffers of this picture
    std::map<std::string, std::unique_ptr<ShaderProgram>> programs_;
    GlVertexArray no_attributes_;
    MarkLayer marks_;
    DepthTiles tiles_;
    std::vector<HiddenRun> hidden_; ///< while a picture is drawn in steps
    int tests_left_out_ = 0;        ///< pictures in which nothing hidden is looked for
    int useless_tests_ = 0;         ///< pictures in a row in which little was hidden
    DistanceLayer distances_;
};

} // namespace abut
