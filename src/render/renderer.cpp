#include <abut/error.h>
#include <abut/renderer.h>

#include "render/renderer_data.h"

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint32_t kNumberBits = 0x3fffffff; ///< 0: background; all: the ground

void require_open(const RendererData& data) {
    if (!data.is_open)
        throw Error(ErrorCode::bad_argument, "a picture has not been begun");
}

void require_context() {
    if (epoxy_gl_version() < 33)
        throw Error(ErrorCode::unsupported, "no picture can be drawn here: there is no OpenGL 3.3");
}

GLuint bound_framebuffer() {
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    return static_cast<GLuint>(bound);
}

Picture read_picture(const RenderTarget& target) {
    Picture picture{target.width(), target.height(), {}};
    const std::size_t width = picture.width, height = picture.height;
    // In the format of the buffer, so that the driver only copies.
    std::vector<std::array<std::uint8_t, 4>> upward(width * height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
    glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA,
                 GL_UNSIGNED_BYTE, upward.data());
    picture.pixels.resize(3 * width * height);
    for (std::size_t y = 0; y < height; ++y) {
        const auto* from = upward.data() + (height - 1 - y) * width;
        std::uint8_t* to = picture.pixels.data() + 3 * y * width;
        for (std::size_t x = 0; x < width; ++x, to += 3)
            to[0] = from[x][0], to[1] = from[x][1], to[2] = from[x][2];
    }
    return picture;
}

} // namespace

Renderer::Renderer(std::size_t parts, const Vec3& origin) {
    require_context();
    data_ = std::make_unique<RendererData>(parts, origin);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_state(std::uint32_t part, const PartState& state) {
    data_->states.set(part, state);
}
PartState Renderer::state(std::uint32_t part) const {
    return data_->states.state(part);
}
bool Renderer::has_ghosts() const {
    return data_->states.has_ghosts();
}

std::uint32_t Renderer::add_part(const Mesh& mesh, const Transform& world_from_mesh,
                                 const PartState& state) {
    const std::uint32_t part = data_->extra.add(mesh, world_from_mesh);
    data_->states.set(part, state);
    return part;
}
void Renderer::move_part(std::uint32_t part, const Transform& world_from_mesh) {
    data_->extra.move(part, world_from_mesh);
}
void Renderer::remove_part(std::uint32_t part) {
    data_->extra.remove(part);
    data_->states.set(part, {});
}

void Renderer::begin(const Camera& camera, const RenderStyle& style) {
    const GLuint target = bound_framebuffer();
    data_->begin(camera, style);
    data_->target = target;
}

void Renderer::add(const ViewFrame& frame) {
    require_open(*data_);
    data_->draw_chunks(frame);
}

void Renderer::add_ghosts(const ViewFrame& frame) {
    require_open(*data_);
    data_->draw_ghosts(frame);
}

void Renderer::end(std::span<const Mark> marks) {
    require_open(*data_);
    data_->finish(data_->target, marks);
}

Picture Renderer::end_picture(std::span<const Mark> marks) {
    require_open(*data_);
    const RenderTarget& target = data_->targets.picture();
    data_->finish(target.framebuffer(), marks);
    Picture picture = read_picture(target);
    glBindFramebuffer(GL_FRAMEBUFFER, data_->target);
    return picture;
}

void Renderer::add_all(const ViewFrame& frame) {
    add(frame);
    if (!has_ghosts())
        return;
    ViewFrame again = frame; // its chunks are there already
    again.uploads = {};
    again.drops = {};
    add_ghosts(again);
}

void Renderer::draw(const ViewFrame& frame, const Camera& camera, const RenderStyle& style,
                    std::span<const Mark> marks) {
    begin(camera, style);
    add_all(frame);
    end(marks);
}

Picture Renderer::picture(const ViewFrame& frame, const Camera& camera, const RenderStyle& style,
                          std::span<const Mark> marks) {
    begin(camera, style);
    add_all(frame);
    return end_picture(marks);
}

std::optional<std::uint32_t> Renderer::part_at(std::uint32_t x, std::uint32_t y) {
    if (!data_->camera || x >= data_->camera->width || y >= data_->camera->height)
        return std::nullopt;
    const std::uint32_t samples = data_->style.samples;
    const std::uint32_t row = data_->camera->height - 1 - y;
    std::array<GLuint, 2> found{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, data_->targets.parts().framebuffer());
    glReadPixels(static_cast<GLint>(x * samples + samples / 2),
                 static_cast<GLint>(row * samples + samples / 2), 1, 1, GL_RG_INTEGER,
                 GL_UNSIGNED_INT, found.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, data_->target);
    const GLuint number = found[0] & kNumberBits;
    if (number == 0 || number == kNumberBits)
        return std::nullopt;
    return number - 1;
}

std::vector<std::uint64_t> Renderer::visible_samples(std::span<const std::uint32_t> parts) {
    std::vector<std::uint64_t> counts(parts.size(), 0);
    if (!data_->camera)
        return counts;
    const RenderTarget& target = data_->targets.parts();
    std::vector<std::array<GLuint, 2>> samples(std::size_t{target.width()} * target.height());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
    glReadPixels(0, 0, static_cast<GLsizei>(target.width()), static_cast<GLsizei>(target.height()),
                 GL_RG_INTEGER, GL_UNSIGNED_INT, samples.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, data_->target);
    for (const auto& sample : samples)
        for (std::size_t i = 0; i < parts.size(); ++i)
            counts[i] += (sample[0] & kNumberBits) == parts[i] + 1 ? 1 : 0;
    return counts;
}

RenderStatistics Renderer::statistics() const {
    const ChunkBuffers& chunks = data_->chunks;
    return {chunks.triangles(), chunks.draw_calls(), chunks.left_out_triangles(),
            chunks.chunks(),    chunks.bytes(),      chunks.uploaded_bytes()};
}

} // namespace abut
