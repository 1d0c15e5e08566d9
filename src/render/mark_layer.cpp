#include "render/mark_layer.h"

#include "math/rounding.h"
#include "math/vector.h"
#include "render/shaders/mark_shaders.h"

#include <cmath>
#include <vector>

namespace abut {

namespace {

struct MarkVertex {
    std::array<float, 3> at, across, colour;
};

/// A point of the picture: pixels from the lower left corner, and depth.
Vec3 pixel_of(const DrawnCamera& camera, const Vec3& point) {
    const Vec3 seen = camera.project(point);
    return {(seen.x + 1) / 2 * camera.width, (seen.y + 1) / 2 * camera.height, seen.z};
}

/// The part of a segment in front of the camera; false if there is none.
bool clip_to_front(const DrawnCamera& camera, Vec3& a, Vec3& b) {
    const double depth_a = dot(camera.forward, a - camera.eye) - camera.near;
    const double depth_b = dot(camera.forward, b - camera.eye) - camera.near;
    if (!(depth_a > 0) && !(depth_b > 0))
        return false;
    if (depth_a < 0 || depth_b < 0) {
        // Slightly in front, so that the depth of the new end is not rounded to one behind.
        const double t = depth_a / (depth_a - depth_b) + (depth_a < 0 ? 1e-9 : -1e-9);
        (depth_a < 0 ? a : b) = a + t * (b - a);
    }
    return true;
}

void add_quad(std::vector<MarkVertex>& vertices, const Mark& mark, const Vec3& a, const Vec3& b) {
    const double half = std::max(0.5, static_cast<double>(mark.width) / 2), reach = half + 1;
    const double dx = b.x - a.x, dy = b.y - a.y, span = std::hypot(dx, dy);
    const double ux = span > 0 ? dx / span : 1, uy = span > 0 ? dy / span : 0;
    const std::array<float, 3> colour{to_float(mark.colour.red / 255.0),
                                      to_float(mark.colour.green / 255.0),
                                      to_float(mark.colour.blue / 255.0)};
    const auto corner = [&](bool at_b, double side) -> MarkVertex {
        const Vec3& end = at_b ? b : a;
        const double along = at_b ? reach : -reach;
        // A dot is round. The ends of a segment are flat.
        const double beyond = span > 0 ? 0 : along;
        return {to_floats({end.x + (beyond * ux) - side * reach * uy,
                           end.y + (beyond * uy) + side * reach * ux, end.z}),
                to_floats({side * reach, beyond, half}), colour};
    };
    const std::array<MarkVertex, 4> corners{corner(false, -1), corner(true, -1), corner(true, 1),
                                            corner(false, 1)};
    for (const std::size_t i : {0, 1, 2, 0, 2, 3})
        vertices.push_back(corners.at(i));
}

} // namespace

void MarkLayer::draw(std::span<const Mark> marks, const DrawnCamera& camera,
                     const std::array<float, 3>& depth_to_w, std::uint32_t samples) {
    std::vector<MarkVertex> vertices;
    for (const Mark& mark : marks) {
        Vec3 a = mark.a, b = mark.b;
        if (is_finite(a) && is_finite(b) && clip_to_front(camera, a, b))
            add_quad(vertices, mark, pixel_of(camera, a), pixel_of(camera, b));
    }
    if (vertices.empty())
        return;
    if (!program_)
        program_ = std::make_unique<ShaderProgram>("", kMarkVertexShader, kMarkFragmentShader);
    program_->use();
    program_->set("u_depth", 1);
    program_->set("u_depth_to_w", depth_to_w);
    program_->set("u_samples", static_cast<int>(samples));
    program_->set("u_size", std::array<float, 2>{static_cast<float>(camera.width),
                                                 static_cast<float>(camera.height)});
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(MarkVertex)),
                 vertices.data(), GL_STREAM_DRAW);
    for (GLuint i = 0; i < 3; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(MarkVertex),
                              reinterpret_cast<const void*>(i * 3 * sizeof(float))); // NOLINT
    }
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
    glDisable(GL_BLEND);
    glBindVertexArray(0);
}

} // namespace abut
