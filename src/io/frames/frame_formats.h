#pragma once

#include <abut/mesh.h>

#include "io/file/byte_stream.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Takes the faces of a frame as they are read.
class FrameFaces {
public:
    FrameFaces() = default;
    FrameFaces(const FrameFaces&) = delete;
    FrameFaces& operator=(const FrameFaces&) = delete;
    virtual ~FrameFaces() = default;
    /// At most so many follow.
    virtual void expect(std::uint64_t /*faces*/) {}
    /// In          corners: indices of vertices, below 2^32 or not to be used.
    virtual void take(std::span<const std::uint64_t> corners) = 0;
};

/// Vertices and faces of a file's content, as read_frame gives them.
///
/// In/out      appends to positions.
/// Errors      Fault: malformed, unsupported, bad_mesh for an index out of range. Coordinates are
///             not looked at.
void read_obj_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces);
void read_ply_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces);

/// Calls `take` with each triangle of a polygon's fan from its first corner; there is none for less
/// than three corners.
///
/// Ears, as triangulate() of the reader program cuts them, depend on positions: the frames of a
/// sequence would have different triangles.
template <typename Take>
void for_each_of_fan(std::span<const std::uint64_t> corners, const Take& take) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        take(std::array{static_cast<std::uint32_t>(corners[0]),
                        static_cast<std::uint32_t>(corners[i - 1]),
                        static_cast<std::uint32_t>(corners[i])});
}

/// Keeps the triangles.
class CollectedFaces : public FrameFaces {
public:
    explicit CollectedFaces(std::vector<std::array<std::uint32_t, 3>>& triangles)
        : triangles_(triangles) {}
    void expect(std::uint64_t faces) override { triangles_.reserve(triangles_.size() + faces); }
    void take(std::span<const std::uint64_t> corners) override {
        for_each_of_fan(corners, [&](const auto& triangle) { triangles_.push_back(triangle); });
    }

private:
    std::vector<std::array<std::uint32_t, 3>>& triangles_;
};

/// Errors      Error{bad_mesh}, naming the file, if the mesh is no frame: as require_valid, or
///             without triangles.
void require_frame(const Mesh& mesh, const std::string& path);

} // namespace abut
