#pragma once

#include <abut/error.h>
#include <abut/scene.h>
#include <abut/types.h>

#include "io/scene/model_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Writes scene_stream.h to a descriptor, in order: the header, the meshes, the parts, the end.
///
/// Errors      ends the process with scene_stream::kOutOfMemory if the result has no room.
class StreamWriter {
public:
    explicit StreamWriter(int descriptor);

    /// In          applied: metres per coordinate that is written, as scale_of expects it.
    void begin(const FormatFrame& frame, double applied, std::uint64_t meshes, std::uint64_t parts);
    void begin_mesh(std::uint32_t vertices, std::uint32_t triangles);
    void positions(const float* xyz, std::size_t vertices);
    void triangle(const std::array<std::uint32_t, 3>& abc);
    void part(const Transform& world_from_mesh, std::uint32_t mesh, std::string_view id,
              std::string_view name, std::string_view type, const std::optional<Colour>& colour);
    void end();
    /// Writes an error in place of everything else; nothing may have been written before.
    void error(ErrorCode code, std::string_view text);

private:
    void put(const void* data, std::size_t size);
    void flush();

    int descriptor_;
    std::vector<char> buffer_;
};

} // namespace abut
