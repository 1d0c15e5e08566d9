#include "render/chunk_buffers.h"

#include "math/vector.h"

#include <algorithm>
#include <cstddef>

namespace abut {

namespace {

/// In software, triangles are collected until a flush, and then rasterised by other threads. So
/// these have work while the next triangles are collected.
constexpr std::uint64_t kTrianglesOfFlush = 16'384;

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
    chunk.runs = triangle_runs(data);
    for (const TriangleRun& run : chunk.runs)
        for (std::size_t k = 0; k < 3; ++k) {
            float &low = chunk.lower_corner.at(k), &high = chunk.upper_corner.at(k);
            const bool is_first = &run == chunk.runs.data();
            low = is_first ? run.lower.at(k) : std::min(low, run.lower.at(k));
            high = is_first ? run.upper.at(k) : std::max(high, run.upper.at(k));
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
    const auto &low = chunk.lower_corner, &high = chunk.upper_corner;
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

void ChunkBuffers::Ranges::add(std::uint32_t first, std::uint32_t end) {
    if (!counts.empty() && end_ == first) {
        counts.back() += static_cast<GLsizei>(end - first);
    } else {
        counts.push_back(static_cast<GLsizei>(end - first));
        offsets.push_back(offset_of(std::size_t{first} * sizeof(GLushort)));
    }
    end_ = end;
}

void ChunkBuffers::Ranges::clear() {
    counts.clear();
    offsets.clear();
}

/// Draws the listed ranges of a chunk, the closed ones without their backs.
void ChunkBuffers::draw_ranges(const Chunk& chunk, ShaderProgram& program) {
    if (closed_.counts.empty() && open_.counts.empty())
        return;
    glBindVertexArray(chunk.array.name());
    program.set("u_lower", chunk.lower);
    program.set("u_step", chunk.step);
    for (const Ranges* const ranges : {&closed_, &open_}) {
        if (ranges->counts.empty())
            continue;
        if (ranges == &closed_)
            glEnable(GL_CULL_FACE);
        glMultiDrawElements(GL_TRIANGLES, ranges->counts.data(), GL_UNSIGNED_SHORT,
                            ranges->offsets.data(), static_cast<GLsizei>(ranges->counts.size()));
        ++draw_calls_;
        for (const GLsizei count : ranges->counts)
            count_triangles(static_cast<std::uint64_t>(count) / 3);
        if (ranges == &closed_)
            glDisable(GL_CULL_FACE);
    }
}

void ChunkBuffers::count_triangles(std::uint64_t count) {
    triangles_ += count;
    if (!in_software_ || (waiting_ += count) < kTrianglesOfFlush)
        return;
    glFlush();
    waiting_ = 0;
}

void ChunkBuffers::draw(const ViewFrame& frame, ShaderProgram& program,
                        const SkippedTriangles& left_out, std::vector<HiddenRun>* hidden) {
    for (const ChunkDraw& draw : frame.draws) {
        const auto found = chunks_.find(draw.chunk);
        if (draw.instances > 0 || found == chunks_.end() || found->second.index_count == 0)
            continue;
        const Chunk& chunk = found->second;
        const std::uint32_t closed = closed_indices(chunk, {}, left_out);
        closed_.clear(), open_.clear();
        const bool all = left_out.outside_of == nullptr && left_out.behind == nullptr;
        if (all && closed > 0)
            closed_.add(0, closed);
        const auto count = static_cast<std::uint32_t>(chunk.index_count);
        if (all && closed < count)
            open_.add(closed, count);
        if (!all)
            list_runs(draw.chunk, chunk, closed, left_out, hidden);
        draw_ranges(chunk, program);
    }
    glBindVertexArray(0);
}

/// Lists the ranges of a chunk that may be visible.
void ChunkBuffers::list_runs(std::uint32_t number, const Chunk& chunk, std::uint32_t closed,
                             const SkippedTriangles& left_out, std::vector<HiddenRun>* hidden) {
    const std::uint32_t planes =
        left_out.outside_of == nullptr
            ? 0
            : left_out.outside_of->cut(chunk.lower_corner, chunk.upper_corner, Frustum::kAllPlanes);
    const bool all_hidden = left_out.behind != nullptr &&
                            left_out.behind->hides(chunk.lower_corner, chunk.upper_corner);
    for (std::uint32_t i = 0; i < chunk.runs.size(); ++i) {
        const TriangleRun& run = chunk.runs[i];
        const std::uint64_t triangles = (run.end - run.first) / 3;
        if (planes == Frustum::kOutside ||
            (planes != 0 &&
             left_out.outside_of->cut(run.lower, run.upper, planes) == Frustum::kOutside)) {
            left_out_triangles_ += triangles;
            continue;
        }
        const bool is_hidden = all_hidden || (left_out.behind != nullptr &&
                                              left_out.behind->hides(run.lower, run.upper));
        if (!is_hidden)
            (run.first < closed ? closed_ : open_).add(run.first, run.end);
        else if (hidden != nullptr)
            hidden->push_back({number, i});
        else
            left_out_triangles_ += triangles;
    }
}

void ChunkBuffers::draw(std::span<const HiddenRun> runs, ShaderProgram& program,
                        const SkippedTriangles& left_out) {
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
        const std::uint32_t number = runs[begin].chunk;
        const Chunk& chunk = chunks_.at(number);
        const std::uint32_t closed = closed_indices(chunk, {}, left_out);
        closed_.clear(), open_.clear();
        for (; end < runs.size() && runs[end].chunk == number; ++end) {
            const TriangleRun& run = chunk.runs[runs[end].run];
            if (left_out.behind->hides(run.lower, run.upper))
                left_out_triangles_ += (run.end - run.first) / 3;
            else
                (run.first < closed ? closed_ : open_).add(run.first, run.end);
        }
        draw_ranges(chunk, program);
    }
    glBindVertexArray(0);
}

/// How many of a chunk's first indices are drawn without their backs.
std::uint32_t ChunkBuffers::closed_indices(const Chunk& chunk,
                                           std::span<const ChunkInstance> instances,
                                           const SkippedTriangles& left_out) {
    const bool without_backs = left_out.backs_seen_from != nullptr && chunk.closed_count > 0 &&
                               is_outside(chunk, instances, *left_out.backs_seen_from);
    return without_backs ? static_cast<std::uint32_t>(chunk.closed_count) : 0;
}

void ChunkBuffers::draw_instances(const ViewFrame& frame, ShaderProgram& program,
                                  const SkippedTriangles& left_out) {
    for (const ChunkDraw& draw : frame.draws) {
        const auto found = chunks_.find(draw.chunk);
        if (draw.instances == 0 || found == chunks_.end() || found->second.index_count == 0)
            continue;
        const Chunk& chunk = found->second;
        glBindVertexArray(chunk.array.name());
        program.set("u_lower", chunk.lower);
        program.set("u_step", chunk.step);
        bind_instances(draw.first_instance);
        const auto draw_range = [&](GLsizei from, GLsizei to) {
            if (from == to)
                return;
            glDrawElementsInstanced(GL_TRIANGLES, to - from, GL_UNSIGNED_SHORT,
                                    offset_of(static_cast<std::size_t>(from) * sizeof(GLushort)),
                                    static_cast<GLsizei>(draw.instances));
            ++draw_calls_;
        };
        const auto closed = static_cast<GLsizei>(closed_indices(
            chunk, frame.instances.subspan(draw.first_instance, draw.instances), left_out));
        if (closed > 0) {
            glEnable(GL_CULL_FACE);
            draw_range(0, closed);
            glDisable(GL_CULL_FACE);
        }
        draw_range(closed, chunk.index_count);
        count_triangles(std::uint64_t{draw.instances} *
                        static_cast<std::uint64_t>(chunk.index_count) / 3);
    }
    glBindVertexArray(0);
}

} // namespace abut
