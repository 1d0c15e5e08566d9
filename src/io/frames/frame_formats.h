#pragma once

#include <abut/mesh.h>

#include "io/file/byte_stream.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Receives the faces of a frame as they are read.
class FrameFaces {
public:
    FrameFaces() = default;
    FrameFaces(const FrameFaces&) = delete;
    FrameFaces& operator=(const FrameFaces&) = delete;
    virtual ~FrameFaces() = default;
    /// Announces that at most this many faces follow.
    virtual void expect(std::uint64_t /*faces*/) {}
    /// In          corners: indices of vertices; one of 2^32 or more must not be used.
    virtual void take(std::span<const std::uint64_t> corners) = 0;
};

/// Reads the vertices and faces of a file, as read_frame returns them.
///
/// In/out      appends to positions.
/// Errors      Fault: malformed, unsupported, bad_mesh for an index out of range. Coordinates are
///             not checked.
void read_obj_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces);
void read_ply_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces);

/// Calls `take` with each triangle of a polygon's fan from its first corner. A polygon of fewer
/// than three corners has no triangle.
///
/// A triangulation into ears, as by triangulate(), depends on positions: the frames of a sequence
/// would have different triangles.
template <typename Take>
void for_each_of_fan(std::span<const std::uint64_t> corners, const Take& take) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        take(std::array{static_cast<std::uint32_t>(corners[0]),
                        static_cast<std::uint32_t>(corners[i - 1]),
                        static_cast<std::uint32_t>(corners[i])});
}

/// Stores the triangles.
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

/// Checks that a mesh is a valid frame.
///
/// Errors      Error{bad_mesh}, naming the file: as require_valid, or if there are no triangles.
void require_frame(const Mesh& mesh, const std::string& path);

} // namespace abut
