#include "view/levels/chunk_codec.h"

#include "io/file/fault.h"
#include "store/codec/byte_planes.h"
#include "store/codec/zstd_frame.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

namespace abut {

namespace {

struct ChunkHeader {
    std::uint32_t vertices = 0, triangles = 0, parts = 0, runs = 0, points = 0;
    std::uint32_t closed_triangles = 0;
    float resting = 0;
    std::array<float, 3> lower{}, step{};
};

constexpr std::size_t kMostVertices = 65536, kMostCodedTriangles = std::size_t{1} << 20;
/// The largest chunk before compression.
constexpr std::uint64_t kLargestChunkBytes = std::uint64_t{1} << 25;

using PointKey = std::array<std::uint16_t, 3>;

std::uint16_t zigzag_16(std::uint16_t difference) {
    return static_cast<std::uint16_t>(difference << 1 ^ (0 - (difference >> 15)));
}
std::uint16_t unzigzag_16(std::uint16_t code) {
    return static_cast<std::uint16_t>(code >> 1 ^ (0 - (code & 1)));
}

struct PointLists {
    std::vector<std::uint16_t> back; ///< by vertex: 0 for a new point
    std::array<std::vector<std::uint16_t>, 3> steps;
};

PointLists list_points(const std::vector<ChunkVertex>& vertices) {
    PointLists lists;
    struct Hash {
        std::size_t operator()(const PointKey& p) const {
            return (std::uint64_t{p[0]} | std::uint64_t{p[1]} << 16 | std::uint64_t{p[2]} << 32) *
                       0x9e3779b97f4a7c15 >>
                   16;
        }
    };
    std::unordered_map<PointKey, std::uint32_t, Hash> number_of;
    number_of.reserve(vertices.size());
    PointKey last{};
    std::uint32_t points = 0;
    for (const ChunkVertex& v : vertices) {
        const auto [found, is_new] = number_of.try_emplace(v.position, points);
        if (!is_new && points - found->second <= 0xffff) {
            lists.back.push_back(static_cast<std::uint16_t>(points - found->second));
            continue;
        }
        found->second = points++;
        lists.back.push_back(0);
        for (std::size_t k = 0; k < 3; ++k)
            lists.steps.at(k).push_back(
                zigzag_16(static_cast<std::uint16_t>(v.position.at(k) - last.at(k))));
        last = v.position;
    }
    return lists;
}

template <typename Word>
void append_list(std::vector<std::byte>& out, const std::vector<Word>& words) {
    append_planes(out, std::span<const Word>(words));
}

template <typename Word>
std::vector<Word> take_list(std::span<const std::byte>& in, std::size_t count) {
    std::vector<Word> words(count);
    if (!take_planes(in, std::span<Word>(words)))
        malformed("it is too short");
    return words;
}

void append_part_rows(std::vector<std::byte>& out, const std::vector<std::int64_t>& parts) {
    std::vector<std::uint64_t> words;
    std::int64_t last = 0;
    for (const std::int64_t part : parts) {
        words.push_back(static_cast<std::uint64_t>(part) - static_cast<std::uint64_t>(last));
        last = part;
    }
    append_list(out, words);
}

std::vector<std::uint32_t> runs_of(const std::vector<ChunkVertex>& vertices) {
    std::vector<std::uint32_t> runs; // part, length, part, length ...
    for (const ChunkVertex& v : vertices) {
        if (runs.empty() || runs[runs.size() - 2] != v.part) {
            runs.push_back(v.part);
            runs.push_back(0);
        }
        ++runs.back();
    }
    for (std::size_t i = runs.size(); i >= 4; i -= 2)
        runs[i - 2] = zigzag(runs[i - 2] - runs[i - 4]);
    return runs;
}

std::vector<std::uint32_t> corner_codes(const std::vector<std::uint16_t>& indices) {
    std::vector<std::uint32_t> codes;
    codes.reserve(indices.size());
    std::uint32_t next = 0;
    for (const std::uint32_t corner : indices) {
        codes.push_back(zigzag(next - corner));
        next = std::max(next, corner + 1);
    }
    return codes;
}

void take_parts(std::span<const std::byte>& in, const ChunkHeader& header, PartChunk& to) {
    std::uint64_t row = 0;
    for (const std::uint64_t step : take_list<std::uint64_t>(in, header.parts))
        to.parts.push_back(static_cast<std::int64_t>(row += step));
    to.errors = take_list<std::uint8_t>(in, header.parts);
    const std::vector<std::uint32_t> runs =
        take_list<std::uint32_t>(in, std::size_t{2} * header.runs);
    std::size_t at = 0;
    std::uint32_t part = 0;
    for (std::size_t i = 0; i < runs.size(); i += 2) {
        part = i == 0 ? runs[0] : part + unzigzag(runs[i]);
        if (runs[i + 1] > header.vertices - at || part >= header.parts)
            malformed("its parts are wrong");
        for (std::uint32_t k = 0; k < runs[i + 1]; ++k)
            to.chunk.vertices[at++].part = part;
    }
    if (at != header.vertices)
        malformed("its parts are wrong");
}

void take_points(std::span<const std::byte>& in, const ChunkHeader& header,
                 std::vector<ChunkVertex>& to) {
    const auto back = take_list<std::uint16_t>(in, header.vertices);
    std::array<std::vector<std::uint16_t>, 3> steps;
    for (auto& axis : steps)
        axis = take_list<std::uint16_t>(in, header.points);
    std::vector<PointKey> points;
    points.reserve(header.points);
    PointKey last{};
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (back[i] > points.size() || (back[i] == 0 && points.size() == header.points))
            malformed("its points are wrong");
        if (back[i] == 0) {
            for (std::size_t k = 0; k < 3; ++k)
                last.at(k) = static_cast<std::uint16_t>(last.at(k) +
                                                        unzigzag_16(steps.at(k)[points.size()]));
            points.push_back(last);
        }
        to[i].position = points[points.size() - std::max<std::size_t>(back[i], 1)];
    }
}

} // namespace

std::vector<std::byte> encode_chunk(const PartChunk& from) {
    const ViewChunk& chunk = from.chunk;
    const PointLists points = list_points(chunk.vertices);
    const std::vector<std::uint32_t> runs = runs_of(chunk.vertices);
    const ChunkHeader header{static_cast<std::uint32_t>(chunk.vertices.size()),
                             static_cast<std::uint32_t>(chunk.indices.size() / 3),
                             static_cast<std::uint32_t>(from.parts.size()),
                             static_cast<std::uint32_t>(runs.size() / 2),
                             static_cast<std::uint32_t>(points.steps[0].size()),
                             chunk.closed_triangles,
                             from.resting,
                             chunk.lower,
                             chunk.step};
    std::vector<std::byte> raw(sizeof header);
    std::memcpy(raw.data(), &header, sizeof header);
    append_part_rows(raw, from.parts);
    append_list(raw, from.errors);
    append_list(raw, runs);
    append_list(raw, points.back);
    for (const auto& axis : points.steps)
        append_list(raw, axis);
    for (std::size_t k = 0; k < 2; ++k)
        for (const ChunkVertex& v : chunk.vertices)
            raw.push_back(static_cast<std::byte>(v.normal.at(k)));
    append_list(raw, corner_codes(chunk.indices));
    return compress(raw);
}

PartChunk decode_chunk(std::span<const std::byte> data) {
    const std::uint64_t bytes = content_bytes(data);
    if (bytes < sizeof(ChunkHeader) || bytes > kLargestChunkBytes)
        malformed("its length is wrong");
    const std::vector<std::byte> raw = decompress(data, bytes);
    if (raw.size() != bytes)
        malformed("it cannot be decompressed");
    ChunkHeader header;
    std::memcpy(&header, raw.data(), sizeof header);
    if (header.vertices > kMostVertices || header.triangles > kMostCodedTriangles ||
        header.runs > header.vertices || header.points > header.vertices ||
        header.parts > bytes / sizeof(std::uint64_t) ||
        header.closed_triangles > header.triangles || !(header.resting >= 0))
        malformed("its header is wrong");
    std::span<const std::byte> rest = std::span(raw).subspan(sizeof header);
    PartChunk result;
    ViewChunk& chunk = result.chunk;
    chunk.lower = header.lower, chunk.step = header.step;
    chunk.closed_triangles = header.closed_triangles;
    result.resting = header.resting;
    chunk.vertices.resize(header.vertices);
    take_parts(rest, header, result);
    take_points(rest, header, chunk.vertices);
    for (std::size_t k = 0; k < 2; ++k) {
        const auto normals = take_list<std::uint8_t>(rest, header.vertices);
        for (std::size_t i = 0; i < normals.size(); ++i)
            chunk.vertices[i].normal.at(k) = static_cast<std::int8_t>(normals[i]);
    }
    std::uint32_t next = 0;
    for (const std::uint32_t code :
         take_list<std::uint32_t>(rest, std::size_t{3} * header.triangles)) {
        const std::uint32_t corner = next - unzigzag(code);
        if (corner >= header.vertices)
            malformed("a corner is out of range");
        chunk.indices.push_back(static_cast<std::uint16_t>(corner));
        next = std::max(next, corner + 1);
    }
    if (!rest.empty())
        malformed("it is too long");
    return result;
}

} // namespace abut
