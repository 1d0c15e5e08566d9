#include "massive/work_piece.h"

#include <algorithm>

namespace abut {

namespace {

/// Where a value stands in a sorted list that has it.
std::uint32_t place_of(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

} // namespace

WorkPiece make_piece(const StoredParts& stored, const std::vector<WorkUnit>& units,
                     std::size_t unit) {
    const WorkUnit& work = units[unit];
    WorkPiece piece;
    piece.unit = static_cast<std::uint32_t>(unit);
    for (const std::uint32_t mesh : work.meshes)
        piece.meshes.push_back(
            {stored.meshes[mesh].mesh, stored.meshes[mesh].bytes, WorkPiece::kNoUse});
    std::vector<std::uint32_t> parts;
    parts.reserve(2 * work.pairs.size());
    for (const IndexPair& pair : work.pairs)
        parts.insert(parts.end(), {pair.a(), pair.b()});
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const std::uint32_t part : parts) {
        const StoredPart& p = stored.parts[part];
        piece.parts.push_back({p.row, place_of(work.meshes, p.mesh), p.model});
    }
    for (const IndexPair& pair : work.pairs)
        piece.pairs.push_back({place_of(parts, pair.a()), place_of(parts, pair.b())});
    return piece;
}

} // namespace abut
