#include <abut/batch.h>

#include "rigid/in_parallel.h"

#include <cstdint>

namespace abut {

std::vector<PiecesContacts> collide(const ConvexPieces& a, const ConvexPieces& b,
                                    std::span<const Placement> placements,
                                    const PiecesCollideOptions& options) {
    const PiecesCollideOptions each = of_each(options);
    return in_parallel<PiecesContacts>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            return collide(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
        });
}

std::vector<PiecesGap> distance(const ConvexPieces& a, const ConvexPieces& b,
                                std::span<const Placement> placements,
                                const PiecesDistanceOptions& options) {
    const PiecesDistanceOptions each = of_each(options);
    return in_parallel<PiecesGap>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            return distance(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
        });
}

std::vector<bool> within(const ConvexPieces& a, const ConvexPieces& b,
                         std::span<const Placement> placements, double tolerance,
                         const PiecesWithinOptions& options) {
    const auto answers = in_parallel<std::uint8_t>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            const auto& [world_from_a, world_from_b] = placements[i];
            return static_cast<std::uint8_t>(within(a, world_from_a, b, world_from_b, tolerance));
        });
    return {answers.begin(), answers.end()};
}

std::vector<PiecesDepth> penetration(const ConvexPieces& a, const ConvexPieces& b,
                                     std::span<const Placement> placements,
                                     const PiecesPenetrationOptions& options) {
    const PiecesPenetrationOptions each = of_each(options);
    return in_parallel<PiecesDepth>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            return penetration(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
        });
}

} // namespace abut
