#include "render/chunk_buffers.h"

#include "math/vector.h"

#include <algorithm>
#include <cstddef>

namespace abut {

namespace {

const void* offset_of(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes); // NOLINT: an offset, as OpenGL wants it
}

} // namespace

void ChunkBuffers::upload(std::uint32_t number, const ViewChunk& data) {
    if (const auto old = chunks_.find(number); old != chunks_.end()) {
        bytes_ -= old->second.bytes;
        chunks_.erase(old);
    }
    Chunk chunk;
    const std::uint64_t vertex_bytes = data.vertices.size() * sizeof(ChunkVertex);
    const std::uint64_t index_bytes = data.indices.size() * sizeof(std::uint16_t);
    glBindVertexArray(chunk.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, chunk.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertex_bytes), data.vertices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chunk.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(index_bytes), data.indices.data(),
                 GL_STATIC_DRAW);
    constexpr GLsizei kStride = sizeof(ChunkVertex);
    glVertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_FALSE, kStride,
                          offset_of(offsetof(ChunkVertex, position)));
    glVertexAttribPointer(1, 2, GL_BYTE, GL_TRUE, kStride,
                          offset_of(offsetof(ChunkVertex, normal)));
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, kStride, offset_of(offsetof(ChunkVertex, part)));
    for (GLuint attribute = 0; attribute < 3; ++attribute)
        glEnableVertexAttribArray(attribute);
    chunk.index_count = static_cast<GLsizei>(data.indices.size());
    chunk.closed_count = static_cast<GLsizei>(3 * data.closed_triangles);
    chunk.lower = data.lower;
    chunk.step = data.step;
    std::array<std::uint16_t, 3> least{0xffff, 0xffff, 0xffff}, most{};
    for (const ChunkVertex& v : data.vertices)
        for (std::size_t k = 0; k < 3; ++k) {
            least.at(k) = std::min(least.at(k), v.position.at(k));
            most.at(k) = std::max(most.at(k), v.position.at(k));
        }
    for (std::size_t k = 0; k < 3; ++k) {
        chunk.box_lower.at(k) = data.lower.at(k) + double{data.step.at(k)} * least.at(k);
        chunk.box_upper.at(k) = data.lower.at(k) + double{data.step.at(k)} * most.at(k);
    }
    chunk.bytes = vertex_bytes + index_bytes;
    bytes_ += chunk.bytes;
    uploaded_bytes_ += chunk.bytes;
    chunks_.emplace(number, std::move(chunk));
}

void ChunkBuffers::update(const ViewFrame& frame) {
    for (const std::uint32_t number : frame.drops)
        if (const auto found = chunks_.find(number); found != chunks_.end()) {
            bytes_ -= found->second.bytes;
            chunks_.erase(found);
        }
    for (const ChunkUpload& each : frame.uploads)
        if (each.data)
            upload(each.chunk, *each.data);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(frame.instances.size_bytes()),
                 frame.instances.data(), GL_STREAM_DRAW);
}

void ChunkBuffers::bind_instances(std::uint32_t first) const {
    constexpr GLsizei kStride = sizeof(ChunkInstance);
    const std::size_t at = std::size_t{first} * sizeof(ChunkInstance);
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    for (GLuint row = 0; row < 3; ++row)
        glVertexAttribPointer(3 + row, 4, GL_FLOAT, GL_FALSE, kStride,
                              offset_of(at + std::size_t{row} * 4 * sizeof(float)));
    glVertexAttribIPointer(6, 1, GL_UNSIGNED_INT, kStride,
                           offset_of(at + offsetof(ChunkInstance, part)));
    for (GLuint attribute = 3; attribute < 7; ++attribute) {
        glEnableVertexAttribArray(attribute);
        glVertexAttribDivisor(attribute, 1);
    }
}

std::uint64_t ChunkBuffers::triangles_of(std::uint32_t chunk) const {
    const auto found = chunks_.find(chunk);
    return found == chunks_.end() ? 0 : static_cast<std::uint64_t>(found->second.index_count) / 3;
}

bool ChunkBuffers::is_outside(const Chunk& chunk, std::span<const ChunkInstance> instances,
                              const EyePoint& eye) {
    const auto is_outside_box = [&](const Vec3& lower, const Vec3& upper) {
        return eye.at[0] < lower.x - eye.near || eye.at[0] > upper.x + eye.near ||
               eye.at[1] < lower.y - eye.near || eye.at[1] > upper.y + eye.near ||
               eye.at[2] < lower.z - eye.near || eye.at[2] > upper.z + eye.near;
    };
    const auto &low = chunk.box_lower, &high = chunk.box_upper;
    if (instances.empty())
        return is_outside_box({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
    for (const ChunkInstance& instance : instances) {
        const auto& r = instance.rows;
        const Vec3 x{r[0], r[4], r[8]}, y{r[1], r[5], r[9]}, z{r[2], r[6], r[10]};
        if (!(dot(cross(x, y), z) > 0)) // mirrored: its fronts have the other winding
            return false;
        Vec3 lower{r[3], r[7], r[11]}, upper = lower;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double a = double{r.at(4 * k + axis)} * low.at(axis),
                             b = double{r.at(4 * k + axis)} * high.at(axis);
                double &from = k == 0   ? lower.x
                               : k == 1 ? lower.y
                                        : lower.z,
                       &to = k == 0   ? upper.x
                             : k == 1 ? upper.y
                                      : upper.z;
                from += std::min(a, b), to += std::max(a, b);
            }
        if (!is_outside_box(lower, upper))
            return false;
    }
    return true;
}

void ChunkBuffers::draw(const ViewFrame& frame, bool instanced, ShaderProgram& program,
                        const SkippedTriangles& left_out) {
    const EyePoint* const eye = left_out.backs_seen_from;
    for (const ChunkDraw& draw : frame.draws) {
        if ((draw.instances > 0) != instanced)
            continue;
        const auto found = chunks_.find(draw.chunk);
        if (found == chunks_.end() || found->second.index_count == 0)
            continue;
        const auto &low = found->second.box_lower, &high = found->second.box_upper;
        if (!instanced && left_out.behind != nullptr &&
            left_out.behind->hides({low[0], low[1], low[2]}, {high[0], high[1], high[2]})) {
            ++hidden_chunks_;
            hidden_triangles_ += static_cast<std::uint64_t>(found->second.index_count) / 3;
            continue;
        }
        const Chunk& chunk = found->second;
        glBindVertexArray(chunk.array.name());
        program.set("u_lower", chunk.lower);
        program.set("u_step", chunk.step);
        const std::uint64_t copies = instanced ? draw.instances : 1;
        if (instanced)
            bind_instances(draw.first_instance);
        const auto draw_range = [&](GLsizei from, GLsizei to) {
            if (from == to)
                return;
            const void* const first = offset_of(static_cast<std::size_t>(from) * sizeof(GLushort));
            if (instanced)
                glDrawElementsInstanced(GL_TRIANGLES, to - from, GL_UNSIGNED_SHORT, first,
                                        static_cast<GLsizei>(copies));
            else
                glDrawElements(GL_TRIANGLES, to - from, GL_UNSIGNED_SHORT, first);
            ++draw_calls_;
        };
        const bool without_backs =
            eye != nullptr && chunk.closed_count > 0 &&
            is_outside(chunk, frame.instances.subspan(draw.first_instance, draw.instances), *eye);
        const GLsizei closed = without_backs ? chunk.closed_count : 0;
        if (closed > 0) {
            glEnable(GL_CULL_FACE);
            draw_range(0, closed);
            glDisable(GL_CULL_FACE);
        }
        draw_range(closed, chunk.index_count);
        triangles_ += copies * static_cast<std::uint64_t>(chunk.index_count) / 3;
    }
    glBindVertexArray(0);
}

} // namespace abut
