#pragma once

#include <cstdint>

/// The file that carries compressed geometry to the decoder and its decoded form back. The library
/// shares it with `abut-reader --decode` on descriptor scene_stream::kResultFile. The decoders are
/// third-party code and run in that process, which opens no other file. Byte order is the
/// machine's.
///
///     header   RequestHeader
///     jobs     Job [jobs]
///     inputs   compressed bytes, at Job::input
///     outputs  written by the decoder at Job::output; not trusted by the library
namespace abut::decode_request {

inline constexpr char kMagic[8] = {'a', 'b', 'u', 't', 'd', 'e', 'c', '1'};

struct RequestHeader {
    char magic[8];
    std::uint64_t jobs;
    std::uint64_t done; ///< number of jobs decoded, from the first on; written by the decoder
};
static_assert(sizeof(RequestHeader) == 24);

enum class Kind : std::uint32_t {
    draco,              ///< output: 3 components a vertex; corners_output: u32[corners]
    meshopt_attributes, ///< output: count elements of `stride` bytes
    meshopt_triangles,
    meshopt_indices,
};

enum class Filter : std::uint32_t { none, octahedral, quaternion, exponential };

struct Job {
    std::uint64_t input = 0, input_bytes = 0;
    std::uint64_t output = 0, count = 0;           ///< count: vertices or elements
    std::uint64_t corners_output = 0, corners = 0; ///< for draco: three corners a triangle
    Kind kind = Kind::draco;
    Filter filter = Filter::none;
    std::uint32_t stride = 0;
    std::uint32_t attribute = 0; ///< for draco: unique id of the positions
    std::uint32_t component = 0; ///< for draco: component type, as glTF numbers it
    std::uint32_t unused = 0;
};
static_assert(sizeof(Job) == 72);

} // namespace abut::decode_request
