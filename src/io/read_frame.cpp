#include <abut/error.h>
#include <abut/frame.h>

#include "io/fault.h"
#include "io/frame_formats.h"
#include "io/input_file.h"
#include "mesh/topology.h"

#include <limits>

namespace abut {

void append_fan(std::span<const std::uint64_t> corners,
                std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                             static_cast<std::uint32_t>(corners[i - 1]),
                             static_cast<std::uint32_t>(corners[i])});
}

void require_frame(const Mesh& mesh, const std::string& path) {
    if (mesh.positions.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_mesh, path, "has too many vertices for one mesh");
    if (mesh.triangles.empty())
        throw Error(ErrorCode::bad_mesh, path, "holds no triangles");
    try {
        require_valid(mesh);
    } catch (const Error& error) {
        throw Error(error.code(), path, error.what());
    }
}

namespace {

Mesh read_unchecked(const std::string& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".obj" && extension != ".ply")
        throw Fault(ErrorCode::unsupported, "frames are read from .obj and .ply files only");
    ByteStream content = ByteStream::open(path);
    return extension == ".obj" ? read_obj_frame(content) : read_ply_frame(content);
}

} // namespace

Mesh read_frame(const std::string& path) {
    try {
        Mesh mesh = read_unchecked(path);
        require_frame(mesh, path);
        // Many frames may be held: no more of each than it needs.
        mesh.positions.shrink_to_fit();
        mesh.triangles.shrink_to_fit();
        return mesh;
    } catch (const Fault& fault) {
        throw Error(fault.code(), path, fault.what());
    }
}

} // namespace abut
