#include "store/codec/hierarchy_codec.h"

#include "store/codec/byte_planes.h"
#include "store/codec/zstd_frame.h"

#include <array>
#include <cstring>

namespace abut {

namespace {

using Header = std::array<std::uint32_t, 2>;

} // namespace

std::vector<std::byte> encode_hierarchy(const ModelOutline& outline) {
    const auto& [nodes, order] = outline.tree;
    const Header header{static_cast<std::uint32_t>(nodes.size()),
                        static_cast<std::uint32_t>(outline.axes)};
    std::vector<std::byte> raw(sizeof header);
    std::memcpy(raw.data(), header.data(), sizeof header);
    append_planes(raw, std::span<const std::uint32_t>(nodes));
    std::vector<std::uint32_t> words(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        words[i] = zigzag(order[i] - (i == 0 ? 0 : order[i - 1]));
    append_planes(raw, std::span<const std::uint32_t>(words));
    return compress(raw);
}

std::optional<ModelOutline> decode_hierarchy(std::span<const std::byte> data,
                                             std::uint64_t triangles) {
    // A node has at least two children, which bounds the number of nodes. The length is checked
    // before memory is allocated for it.
    const std::uint64_t raw_bytes = content_bytes(data);
    if (raw_bytes < sizeof(Header) || raw_bytes > sizeof(Header) + 4 * (2 * triangles + 1))
        return std::nullopt;
    const std::vector<std::byte> raw = decompress(data, raw_bytes);
    Header header{};
    if (raw.size() != raw_bytes)
        return std::nullopt;
    std::memcpy(header.data(), raw.data(), sizeof header);
    const auto [nodes, axes] = header;
    if (sizeof header + 4 * (nodes + triangles) != raw_bytes || axes >= kTreeAxes)
        return std::nullopt;
    ModelOutline outline{static_cast<TreeAxes>(axes), {}};
    outline.tree.nodes.resize(nodes);
    outline.tree.order.resize(triangles);
    std::span<const std::byte> rest = std::span(raw).subspan(sizeof header);
    std::vector<std::uint32_t>& order = outline.tree.order;
    if (!take_planes(rest, std::span(outline.tree.nodes)) || !take_planes(rest, std::span(order)))
        return std::nullopt;
    std::uint32_t last = 0;
    for (std::uint32_t& triangle : order)
        triangle = last += unzigzag(triangle);
    if (!is_outline(outline.tree, triangles))
        return std::nullopt;
    return outline;
}

} // namespace abut
