#include "render/chunk_buffers.h"

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
    chunk.lower = data.lower;
    chunk.step = data.step;
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

void ChunkBuffers::draw(const ViewFrame& frame, bool instanced, ShaderProgram& program) {
    for (const ChunkDraw& draw : frame.draws) {
        if ((draw.instances > 0) != instanced)
            continue;
        const auto found = chunks_.find(draw.chunk);
        if (found == chunks_.end() || found->second.index_count == 0)
            continue;
        const Chunk& chunk = found->second;
        glBindVertexArray(chunk.array.name());
        program.set("u_lower", chunk.lower);
        program.set("u_step", chunk.step);
        const std::uint64_t copies = instanced ? draw.instances : 1;
        if (instanced) {
            bind_instances(draw.first_instance);
            glDrawElementsInstanced(GL_TRIANGLES, chunk.index_count, GL_UNSIGNED_SHORT, nullptr,
                                    static_cast<GLsizei>(draw.instances));
        } else {
            glDrawElements(GL_TRIANGLES, chunk.index_count, GL_UNSIGNED_SHORT, nullptr);
        }
        triangles_ += copies * static_cast<std::uint64_t>(chunk.index_count) / 3;
        ++draw_calls_;
    }
    glBindVertexArray(0);
}

} // namespace abut
