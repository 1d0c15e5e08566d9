#include "store/codec/mesh_codec.h"

#include "io/file/fault.h"
#include "math/rounding.h"
#include "store/codec/byte_planes.h"
#include "store/codec/zstd_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

namespace abut {

namespace {

constexpr std::size_t kHeaderBytes = 16;

template <typename Word>
void take_block_planes(std::span<const std::byte>& in, std::span<Word> words) {
    if (!take_planes(in, words))
        malformed("a block is too short");
}

bool all_floats(const std::vector<Vec3>& positions) {
    const auto is_float = [](double v) {
        return std::bit_cast<std::uint64_t>(double{to_float(v)}) == std::bit_cast<std::uint64_t>(v);
    };
    return std::all_of(positions.begin(), positions.end(), [&](const Vec3& p) {
        return is_float(p.x) && is_float(p.y) && is_float(p.z);
    });
}

constexpr std::array kAxes{&Vec3::x, &Vec3::y, &Vec3::z};

template <typename Real, typename Word>
void append_positions(std::vector<std::byte>& out, const std::vector<Vec3>& positions) {
    std::vector<Word> words(positions.size());
    for (const auto axis : kAxes) {
        Word last = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const Word bits = std::bit_cast<Word>(static_cast<Real>(positions[i].*axis));
            words[i] = bits - last;
            last = bits;
        }
        append_planes(out, std::span<const Word>(words));
    }
}

template <typename Real, typename Word>
void take_positions(std::span<const std::byte>& in, std::vector<Vec3>& positions) {
    std::vector<Word> words(positions.size());
    for (const auto axis : kAxes) {
        take_block_planes(in, std::span<Word>(words));
        Word bits = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            bits += words[i];
            positions[i].*axis = std::bit_cast<Real>(bits);
        }
    }
}

void append_ids(std::vector<std::byte>& out, const std::vector<std::uint32_t>& ids) {
    std::vector<std::uint32_t> words(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
        words[i] = ids[i] - (i == 0 ? 0 : ids[i - 1]);
    append_planes(out, std::span<const std::uint32_t>(words));
}

std::vector<std::uint32_t> take_ids(std::span<const std::byte>& in, std::size_t count) {
    std::vector<std::uint32_t> ids(count);
    take_block_planes(in, std::span<std::uint32_t>(ids));
    for (std::size_t i = 1; i < count; ++i) {
        if (ids[i] == 0 || ids[i] > 0xffffffff - ids[i - 1])
            malformed("the numbers of a block do not ascend");
        ids[i] += ids[i - 1];
    }
    return ids;
}

void append_corners(std::vector<std::byte>& out, const Mesh& mesh) {
    std::vector<std::uint32_t> words(3 * mesh.triangles.size());
    std::uint32_t next = 0; // one more than the largest corner so far
    std::size_t i = 0;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            words[i++] = zigzag(next - corner);
            next = std::max(next, corner + 1);
        }
    append_planes(out, std::span<const std::uint32_t>(words));
}

void take_corners(std::span<const std::byte>& in, Mesh& mesh) {
    std::vector<std::uint32_t> words(3 * mesh.triangles.size());
    take_block_planes(in, std::span<std::uint32_t>(words));
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::uint32_t corner = next - unzigzag(words[i]);
        if (corner >= mesh.positions.size())
            malformed("a corner of a block is out of range");
        mesh.triangles[i / 3].at(i % 3) = corner;
        next = std::max(next, corner + 1);
    }
}

} // namespace

EncodedBlock encode_block(const MeshBlock& block) {
    const Mesh& mesh = block.mesh;
    const bool floats = all_floats(mesh.positions);
    const bool is_block = !block.vertex_ids.empty() || !block.triangle_ids.empty();
    const std::array<std::uint32_t, 4> header{static_cast<std::uint32_t>(mesh.positions.size()),
                                              static_cast<std::uint32_t>(mesh.triangles.size()),
                                              floats ? 4U : 8U, is_block ? 1U : 0U};
    std::vector<std::byte> raw(sizeof header);
    std::memcpy(raw.data(), header.data(), sizeof header);
    if (is_block) {
        append_ids(raw, block.vertex_ids);
        append_ids(raw, block.triangle_ids);
    }
    if (floats)
        append_positions<float, std::uint32_t>(raw, mesh.positions);
    else
        append_positions<double, std::uint64_t>(raw, mesh.positions);
    append_corners(raw, mesh);

    EncodedBlock encoded;
    encoded.raw_bytes = raw.size();
    encoded.data = compress(raw);
    return encoded;
}

MeshBlock decode_block(std::span<const std::byte> data, std::uint64_t raw_bytes) {
    // The length is checked before memory is allocated for it.
    if (raw_bytes < kHeaderBytes || raw_bytes > kLargestBlockBytes ||
        content_bytes(data) != raw_bytes)
        malformed("a block's length is wrong");
    const std::vector<std::byte> raw = decompress(data, raw_bytes);
    if (raw.size() != raw_bytes)
        malformed("a block cannot be decompressed");

    std::array<std::uint32_t, 4> header{};
    std::memcpy(header.data(), raw.data(), sizeof header);
    const auto [vertices, triangles, real_bytes, is_block] = header;
    const std::uint64_t words =
        std::uint64_t{3} * triangles + (is_block != 0 ? std::uint64_t{vertices} + triangles : 0);
    if ((real_bytes != 4 && real_bytes != 8) || is_block > 1 ||
        kHeaderBytes + std::uint64_t{3} * vertices * real_bytes + 4 * words != raw_bytes)
        malformed("a block's header is wrong");
    std::span<const std::byte> rest = std::span<const std::byte>(raw).subspan(kHeaderBytes);
    MeshBlock block;
    if (is_block != 0) {
        block.vertex_ids = take_ids(rest, vertices);
        block.triangle_ids = take_ids(rest, triangles);
    }
    block.mesh.positions.resize(vertices);
    block.mesh.triangles.resize(triangles);
    if (real_bytes == 4)
        take_positions<float, std::uint32_t>(rest, block.mesh.positions);
    else
        take_positions<double, std::uint64_t>(rest, block.mesh.positions);
    take_corners(rest, block.mesh);
    return block;
}

} // namespace abut
