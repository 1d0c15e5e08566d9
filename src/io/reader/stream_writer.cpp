#include "io/reader/stream_writer.h"

#include "io/process/scene_stream.h"

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace abut {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

scene_stream::Header header() {
    scene_stream::Header result{};
    std::memcpy(result.magic, scene_stream::kMagic, sizeof result.magic);
    return result;
}

} // namespace

StreamWriter::StreamWriter(int descriptor) : descriptor_(descriptor) {
    buffer_.reserve(kBufferBytes);
}

void StreamWriter::begin(const FormatFrame& frame, double applied, std::uint64_t meshes,
                         std::uint64_t parts) {
    scene_stream::Header start = header();
    start.unit = frame.unit;
    start.applied = applied;
    start.up = frame.up ? 1 + static_cast<std::uint32_t>(*frame.up) : 0;
    start.meshes = meshes;
    start.parts = parts;
    put(&start, sizeof start);
}

void StreamWriter::begin_mesh(std::uint32_t vertices, std::uint32_t triangles) {
    put(&vertices, sizeof vertices);
    put(&triangles, sizeof triangles);
    const std::uint32_t real_bytes = sizeof(float);
    put(&real_bytes, sizeof real_bytes);
}

void StreamWriter::positions(const float* xyz, std::size_t vertices) {
    put(xyz, vertices * 3 * sizeof(float));
}

void StreamWriter::triangle(const std::array<std::uint32_t, 3>& abc) {
    put(abc.data(), sizeof abc);
}

void StreamWriter::part(const Transform& world_from_mesh, std::uint32_t mesh, std::string_view id,
                        std::string_view name, std::string_view type,
                        const std::optional<Colour>& colour) {
    put(world_from_mesh.m.data(), sizeof world_from_mesh.m);
    const std::array<std::uint32_t, 5> numbers{
        mesh, static_cast<std::uint32_t>(id.size()), static_cast<std::uint32_t>(name.size()),
        static_cast<std::uint32_t>(type.size()), colour ? std::uint32_t{1} : 0};
    put(numbers.data(), sizeof numbers);
    const Colour bytes = colour.value_or(Colour());
    put(&bytes, sizeof bytes);
    for (const std::string_view text : {id, name, type})
        put(text.data(), text.size());
}

void StreamWriter::end() {
    const scene_stream::Known nothing{
        .map_from_project = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
        .precision = 0,
        .rounded = scene_stream::kRoundedAll, // as Assimp returns them
        .names = 0,
        .values = 0,
        .relations = 0,
        .project_size = 0,
        .entries = 0,
    };
    put(&nothing, sizeof nothing);
    put(scene_stream::kEnd, sizeof scene_stream::kEnd);
    flush();
}

void StreamWriter::error(ErrorCode code, std::string_view text) {
    scene_stream::Header start = header();
    start.status = 1 + static_cast<std::uint32_t>(code);
    start.text_size = static_cast<std::uint32_t>(text.size());
    put(&start, sizeof start);
    put(text.data(), text.size());
    flush();
}

void StreamWriter::put(const void* data, std::size_t size) {
    if (buffer_.size() + size > kBufferBytes)
        flush();
    const char* bytes = static_cast<const char*>(data);
    while (size > kBufferBytes) {
        buffer_.assign(bytes, bytes + kBufferBytes);
        flush();
        bytes += kBufferBytes;
        size -= kBufferBytes;
    }
    buffer_.insert(buffer_.end(), bytes, bytes + size);
}

void StreamWriter::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t written = write(descriptor_, buffer_.data() + done, buffer_.size() - done);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            _exit(scene_stream::kOutOfMemory);
        done += static_cast<std::size_t>(written);
    }
    buffer_.clear();
}

} // namespace abut
