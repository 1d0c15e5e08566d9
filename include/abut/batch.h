#pragma once

#include <abut/convex_pieces.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <span>
#include <vector>

/// Many queries of one pair of models, or solids of convex pieces, at once: the verbs of rigid.h,
/// motion.h and convex_pieces.h for a list of placements, in parallel (`set_threads`). Each answer equals that of the single query, counters
/// included, and stands at its placement's index. A warm start in the options is left alone: it is one
/// thread's. A limit of steps holds for each query. The stop flag ends all with Error{interrupted}, and
/// reports tell the share of the queries that are done.
///
/// Errors, of all: those of the single query, for the first placement that has one; its message
/// begins with "placement N: ", N counted from 0.
namespace abut {

/// Where both models are.
struct Placement {
    Transform world_from_a, world_from_b;
};

/// How both models move.
struct MotionPair {
    Motion a, b;
};

std::vector<Contacts> collide(const Model& a, const Model& b, std::span<const Placement> placements,
                              const CollideOptions& options = {});

std::vector<Gap> distance(const Model& a, const Model& b, std::span<const Placement> placements,
                          const DistanceOptions& options = {});

std::vector<bool> within(const Model& a, const Model& b, std::span<const Placement> placements,
                         double tolerance, const WithinOptions& options = {});

std::vector<Impact> time_of_impact(const Model& a, const Model& b,
                                   std::span<const MotionPair> motions,
                                   const ImpactOptions& options = {});

std::vector<PiecesContacts> collide(const ConvexPieces& a, const ConvexPieces& b,
                                    std::span<const Placement> placements,
                                    const PiecesCollideOptions& options = {});

std::vector<PiecesGap> distance(const ConvexPieces& a, const ConvexPieces& b,
                                std::span<const Placement> placements,
                                const PiecesDistanceOptions& options = {});

std::vector<bool> within(const ConvexPieces& a, const ConvexPieces& b,
                         std::span<const Placement> placements, double tolerance,
                         const PiecesWithinOptions& options = {});

std::vector<PiecesDepth> penetration(const ConvexPieces& a, const ConvexPieces& b,
                                     std::span<const Placement> placements,
                                     const PiecesPenetrationOptions& options = {});

} // namespace abut
