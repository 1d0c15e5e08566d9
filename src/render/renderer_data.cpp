#include "render/renderer_data.h"

#include <abut/error.h>

#include "math/rounding.h"
#include "math/vector.h"
#include "render/shaders/geometry_shaders.h"
#include "render/shaders/screen_shaders.h"

#include <array>
#include <cmath>
#include <string_view>

namespace abut {

namespace {

/// Hidden triangles are looked for if they are at least one in this number.
constexpr std::uint64_t kWorthwhile = 8;
constexpr int kPicturesWithoutTest = 7;
/// A picture with fewer draws is not worth the test.
constexpr std::size_t kLeastDraws = 32;

constexpr GLuint kPartsUnit = 0, kDepthUnit = 1, kStatesUnit = 2, kOcclusionUnit = 3,
                 kGhostsUnit = 4, kDistancesUnit = 5;

void require_valid_style(const RenderStyle& style) {
    const auto fail = [](const char* message) { throw Error(ErrorCode::bad_argument, message); };
    if (style.samples != 1 && style.samples != 2 && style.samples != 4)
        fail("a picture has 1, 2 or 4 samples along a side of a pixel");
    if (style.sections.size() > kMostSections)
        fail("a picture has at most 7 section planes and a section box");
    if (!is_finite(style.up) || length_sq(style.up) == 0 || !(style.detail > 0))
        fail("the style of a picture needs an up direction and a positive detail");
    if (style.distances && (!style.distances->distance || !(style.distances->reach > 0)))
        fail("colours by distance need a distance and a positive reach");
    for (const SectionPlane& plane : style.sections)
        if (!is_finite(plane.normal) || !std::isfinite(plane.offset))
            fail("a section plane is not finite");
}

void reset_state() {
    for (const GLenum feature : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                                 GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL, GL_DITHER})
        glDisable(feature);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    glDepthMask(GL_TRUE);
}

/// Returns whether OpenGL has no graphics card.
bool draws_in_software() {
    const auto* const text = reinterpret_cast<const char*>(glGetString(GL_RENDERER)); // NOLINT
    const std::string_view name(text != nullptr ? text : "");
    return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
}

std::array<float, 3> to_floats(const Colour& colour) {
    return {to_float(colour.red / 255.0), to_float(colour.green / 255.0),
            to_float(colour.blue / 255.0)};
}

} // namespace

RendererData::RendererData(std::size_t parts, const Vec3& origin)
    : states(parts + ExtraParts::kMost), chunks(draws_in_software()),
      extra(static_cast<std::uint32_t>(parts), origin), origin_(origin),
      in_software_(draws_in_software()), reversed_(epoxy_has_gl_extension("GL_ARB_clip_control")) {}

ShaderProgram& RendererData::program(const std::string& name, const std::string& definitions,
                                     const char* vertex, const char* fragment) {
    std::unique_ptr<ShaderProgram>& held = programs_[name + definitions];
    if (!held)
        held = std::make_unique<ShaderProgram>(definitions, vertex, fragment);
    held->use();
    return *held;
}

std::array<float, 3> RendererData::depth_to_w() const {
    const double n = camera->near, f = camera->far;
    return reversed_ ? abut::to_floats(Vec3{n * f, n, f - n})
                     : abut::to_floats(Vec3{n * f, f, n - f});
}

ShaderProgram& RendererData::geometry(Pass pass, bool instanced) {
    std::string definitions;
    if (instanced)
        definitions += "#define INSTANCED\n";
    if (is_cut() && pass != Pass::ground)
        definitions += "#define SECTION\n";
    if (pass == Pass::ghosts)
        definitions += "#define GHOSTS\n";
    if (pass == Pass::ground)
        definitions += "#define GROUND\n";
    else if (pass == Pass::ghosts || states.has_flags())
        definitions += "#define FLAGS\n";
    if (is_quick())
        definitions += "#define QUICK\n";
    ShaderProgram& used =
        program("geometry", definitions, kGeometryVertexShader, kGeometryFragmentShader);
    used.set_matrix("u_clip_from_world", camera->clip_from_world(origin_, reversed_));
    used.set("u_states", static_cast<int>(kStatesUnit));
    used.set("u_eye", abut::to_floats(camera->eye - origin_));
    if (is_cut())
        set_sections(used);
    return used;
}

void RendererData::set_sections(ShaderProgram& used) const {
    std::vector<float> planes;
    const auto add = [&](const Vec3& normal, double offset) {
        for (const double value : {normal.x, normal.y, normal.z, offset - dot(normal, origin_)})
            planes.push_back(to_float(value));
    };
    for (const SectionPlane& plane : style.sections)
        add(plane.normal, plane.offset);
    if (style.section_box)
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 along{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
            add(along, component(style.section_box->upper, axis));
            add(-along, -component(style.section_box->lower, axis));
        }
    used.set_array("u_planes", planes.data(), static_cast<int>(planes.size() / 4));
    used.set("u_plane_count", static_cast<int>(planes.size() / 4));
}

void RendererData::begin(const Camera& seen_by, const RenderStyle& drawn_in) {
    const DrawnCamera checked(seen_by);
    require_valid_style(drawn_in);
    // If the buffers are refused, there is no picture to go on with or to read from.
    is_open = false;
    camera.reset();
    targets.resize(checked.width, checked.height, drawn_in.samples);
    camera = checked;
    style = drawn_in;
    style.up = normalized_or_zero(style.up);
    has_ground_ = has_ghosts_ = false;
    chunks.reset_counts();
    targets.parts().bind();
    reset_state();
    if (reversed_)
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const GLuint none[4] = {0, 0, 0, 0};
    const float far = reversed_ ? 0.0F : 1.0F;
    glClearBufferuiv(GL_COLOR, 0, none);
    glClearBufferfv(GL_DEPTH, 0, &far);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(reversed_ ? GL_GREATER : GL_LESS);
    is_open = true;
}

EyePoint RendererData::eye_point() const {
    const Vec3 at = camera->eye - origin_;
    // The corners of the picture are the farthest points of the near plane.
    return {{at.x, at.y, at.z},
            camera->near * std::sqrt(1 + camera->slope_x * camera->slope_x +
                                     camera->slope_y * camera->slope_y)};
}

void RendererData::draw_all(const ViewFrame& frame, Pass pass) {
    states.bind(kStatesUnit);
    const EyePoint eye = eye_point();
    const SkippedTriangles left_out{pass == Pass::parts && leaves_out_backs() ? &eye : nullptr,
                                    nullptr, nullptr};
    chunks.draw(frame, geometry(pass, false), left_out);
    chunks.draw_instances(frame, geometry(pass, true), left_out);
}

void RendererData::draw_in_steps(const ViewFrame& frame) {
    states.bind(kStatesUnit);
    const EyePoint eye = eye_point();
    const Frustum frustum(*camera, camera->near, camera->far, origin_);
    SkippedTriangles left_out{leaves_out_backs() ? &eye : nullptr, &frustum, nullptr};
    const bool tests = tests_left_out_-- <= 0;
    tiles_.begin_picture();
    if (tests && tiles_.is_read())
        left_out.behind = &tiles_;
    hidden_.clear();
    chunks.draw(frame, geometry(Pass::parts, false), left_out, &hidden_);
    chunks.draw_instances(frame, geometry(Pass::parts, true), left_out);
    if (!tests)
        return;
    const std::uint64_t outside = chunks.left_out_triangles();
    tiles_.read(targets.parts(), *camera, depth_to_w(), origin_);
    targets.parts().bind();
    left_out.behind = &tiles_;
    chunks.draw(hidden_, geometry(Pass::parts, false), left_out);
    // Where little is hidden in two pictures, the test is left out for some. One alone may follow a
    // jump of the eye.
    const std::uint64_t are_hidden = chunks.left_out_triangles() - outside;
    const bool pays = kWorthwhile * are_hidden >= chunks.triangles() + are_hidden;
    useless_tests_ = pays ? 0 : useless_tests_ + 1;
    if (useless_tests_ == 2)
        useless_tests_ = 0, tests_left_out_ = kPicturesWithoutTest;
}

void RendererData::draw_extra(Pass pass) {
    if (extra.empty())
        return;
    extra.update();
    states.bind(kStatesUnit);
    extra.draw(geometry(pass, true));
}

void RendererData::draw_chunks(const ViewFrame& frame) {
    chunks.update(frame);
    targets.parts().bind();
    if (in_software_ && frame.draws.size() >= kLeastDraws)
        draw_in_steps(frame);
    else
        draw_all(frame, Pass::parts);
    draw_extra(Pass::parts);
}

void RendererData::draw_ground() {
    if (!style.ground || has_ground_ || !(dot(camera->eye - style.ground->middle, style.up) > 0))
        return;
    has_ground_ = true;
    targets.parts().bind();
    const Vec3 x = normalized_or_zero(perpendicular(style.up)), y = cross(style.up, x);
    ShaderProgram& used = geometry(Pass::ground, false);
    used.set("u_ground_centre", abut::to_floats(style.ground->middle - origin_));
    used.set("u_ground_x", abut::to_floats(style.ground->reach * x));
    used.set("u_ground_y", abut::to_floats(style.ground->reach * y));
    used.set("u_ground_normal", abut::to_floats(style.up));
    glBindVertexArray(no_attributes_.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void RendererData::draw_ghosts(const ViewFrame& frame) {
    draw_ground();
    chunks.update(frame);
    targets.ghosts().bind();
    if (!has_ghosts_) {
        const float all[4] = {1, 1, 1, 1};
        glClearBufferfv(GL_COLOR, 0, all);
        has_ghosts_ = true;
    }
    // Each ghost multiplies what is let through, so their order does not matter.
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glDepthMask(GL_FALSE);
    draw_all(frame, Pass::ghosts);
    draw_extra(Pass::ghosts);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void RendererData::set_view(ShaderProgram& used) const {
    const RenderTarget& parts = targets.parts();
    used.set("u_parts", static_cast<int>(kPartsUnit));
    used.set("u_depth", static_cast<int>(kDepthUnit));
    used.set("u_depth_to_w", depth_to_w());
    used.set("u_right", abut::to_floats(camera->slope_x * camera->right));
    used.set("u_up", abut::to_floats(camera->slope_y * camera->up));
    used.set("u_forward", abut::to_floats(camera->forward));
    used.set("u_size", std::array<float, 2>{static_cast<float>(parts.width()),
                                            static_cast<float>(parts.height())});
    used.set("u_pixel", to_float(camera->pixel() / style.samples));
}

void RendererData::draw_occlusion() {
    ShaderProgram& used = program("occlusion", "", kScreenVertexShader, kOcclusionFragmentShader);
    set_view(used);
    used.set("u_reach", to_float(style.detail));
    used.set("u_scale", static_cast<int>(style.samples));
    targets.occlusion().bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ShaderProgram& smooth = program("smooth", "", kScreenVertexShader, kSmoothFragmentShader);
    smooth.set("u_noisy", static_cast<int>(kOcclusionUnit));
    targets.occlusion().bind_texture(0, kOcclusionUnit);
    targets.smooth().bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    targets.smooth().bind_texture(0, kOcclusionUnit);
}

void RendererData::compute_distances() {
    distances_.update(*style.distances, *camera, targets.parts(), depth_to_w(), style.samples,
                      kDistancesUnit);
}

void RendererData::shade() {
    std::string definitions;
    if (style.edges)
        definitions += "#define EDGES\n";
    if (is_quick())
        definitions += "#define QUICK\n";
    if (style.edges && style.samples > 1)
        definitions += "#define STILL\n";
    if (style.ambient_occlusion)
        definitions += "#define OCCLUSION\n";
    if (has_ground_)
        definitions += "#define GROUND\n";
    if (is_cut())
        definitions += "#define SECTION\n";
    if (has_ghosts_)
        definitions += "#define GHOSTS\n";
    if (style.distances)
        definitions += "#define DISTANCES\n";
    if (states.has_highlights())
        definitions += "#define HIGHLIGHTS\n";
    ShaderProgram& used = program("shade", definitions, kScreenVertexShader, kShadeFragmentShader);
    set_view(used);
    used.set("u_states", static_cast<int>(kStatesUnit));
    used.set("u_occlusion", static_cast<int>(kOcclusionUnit));
    used.set("u_ghosts", static_cast<int>(kGhostsUnit));
    used.set("u_occlusion_scale", static_cast<int>(style.samples));
    used.set("u_distances", static_cast<int>(kDistancesUnit));
    used.set("u_detail", to_float(style.detail));
    used.set("u_sky", abut::to_floats(style.up));
    const Vec3 light = 0.9 * style.up + -0.45 * camera->right + -0.6 * camera->forward;
    used.set("u_light", abut::to_floats(normalized_or_zero(light)));
    used.set("u_low", to_floats(style.background_low));
    used.set("u_high", to_floats(style.background_high));
    used.set("u_samples", static_cast<float>(style.samples));
    if (style.ground) {
        used.set("u_eye", abut::to_floats(camera->eye - style.ground->middle));
        used.set("u_ground_reach", to_float(style.ground->reach));
        const Vec3 x = std::abs(style.up.x) < 0.7 ? Vec3{1, 0, 0} - style.up.x * style.up
                                                  : Vec3{0, 1, 0} - style.up.y * style.up;
        used.set("u_ground_x", abut::to_floats(normalized_or_zero(x)));
        used.set("u_grid", to_float(std::pow(10, std::floor(std::log10(style.ground->reach / 4)))));
    }
    if (has_ghosts_)
        targets.ghosts().bind_texture(0, kGhostsUnit);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void RendererData::to_pixels(GLuint framebuffer) {
    const auto copy = [](GLuint from, std::uint32_t width, std::uint32_t height, GLuint to,
                         std::uint32_t to_width, std::uint32_t to_height) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
        // Linear interpolation at half of the size is the mean of 2 x 2 samples.
        glBlitFramebuffer(0, 0, static_cast<GLint>(width), static_cast<GLint>(height), 0, 0,
                          static_cast<GLint>(to_width), static_cast<GLint>(to_height),
                          GL_COLOR_BUFFER_BIT, GL_LINEAR);
    };
    const RenderTarget* from = &targets.colours();
    if (style.samples == 4) {
        const RenderTarget& half = targets.half();
        copy(from->framebuffer(), from->width(), from->height(), half.framebuffer(), half.width(),
             half.height());
        from = &half;
    }
    copy(from->framebuffer(), from->width(), from->height(), framebuffer, camera->width,
         camera->height);
}

void RendererData::finish(GLuint framebuffer, std::span<const Mark> marks) {
    states.bind(kStatesUnit);
    draw_ground();
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(no_attributes_.name());
    targets.parts().bind_texture(0, kPartsUnit);
    targets.parts().bind_texture(1, kDepthUnit);
    if (style.ambient_occlusion)
        draw_occlusion();
    if (style.distances)
        compute_distances();
    const auto width = static_cast<GLsizei>(camera->width);
    const auto height = static_cast<GLsizei>(camera->height);
    if (style.samples > 1) {
        targets.colours().bind();
        shade();
        to_pixels(framebuffer);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    if (style.samples == 1)
        shade();
    marks_.draw(marks, *camera, depth_to_w(), style.samples);
    if (reversed_)
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glActiveTexture(GL_TEXTURE0);
    glUseProgram(0);
    glBindVertexArray(0);
    is_open = false;
}

} // namespace abut
