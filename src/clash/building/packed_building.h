#pragma once

#include <abut/progress.h>

#include "clash/building/building_source.h"
#include "clash/building/shown_parts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace abut {

struct BuildingRequest {
    std::span<const std::uint32_t> clashing; ///< indices in BuildingSource::parts()
    std::span<const Vec3> points;            ///< witness points of the clashes
    std::size_t most_bytes = 0;              ///< approximate size of `PackedBuilding::bytes`
    std::size_t most_parts = 60'000;
    Progress progress{};
};

/// The geometry of a page: compressed streams of meshoptimizer, one after the other.
///
///     for each chunk: vertices (3 u32: x y z on the mesh's grid) | indices of the chunk's vertices
///     meshes: 2 u32 (vertices, indices), in the order of the chunks
///     parts: 3 u32 (mesh, number, model | detail << 16)
///     transforms of the parts: 12 floats, grid to metres about `origin`
struct PackedBuilding {
    struct Chunk {
        std::size_t vertices = 0, indices = 0, vertex_bytes = 0, index_bytes = 0;
    };
    std::vector<Chunk> chunks;
    std::size_t meshes = 0, parts = 0;
    std::size_t mesh_bytes = 0, part_bytes = 0, transform_bytes = 0;
    Vec3 origin;
    Box3 bounds;               ///< of all shown parts, in the world
    std::size_t triangles = 0; ///< each instance counted
    std::size_t left_out = 0;  ///< parts that are not shown
    double clash_share = 1;    ///< of the clashing parts' triangles that are shown
    std::vector<std::byte> bytes;
};

/// Packs the geometry that a page shows. Empty if no part has triangles.
///
/// In          number: part of the report by part of the source; other parts have the number
///             0xffffffff in the page.
/// Errors      those of the source; Error{interrupted}.
/// Cost        reads each mesh at most twice. Takes a few times `most_bytes` of memory, and a piece
///             of a mesh for each thread.
PackedBuilding pack_building(const BuildingSource& source, const BuildingRequest& request,
                             const std::unordered_map<std::uint32_t, std::uint32_t>& number);

/// Base64 with padding [RFC 4648].
std::string base64(std::span<const std::byte> bytes);

} // namespace abut
