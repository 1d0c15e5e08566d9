#pragma once

#include <abut/convex_pieces.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <span>
#include <vector>

/// Many queries of one pair of models, or of one pair of solids made of convex pieces, in one call:
/// the functions of rigid.h, motion.h and convex_pieces.h for a list of placements. The queries run
/// in parallel (`set_threads`).
///
/// Each answer, its counters included, equals that of the single query, and has the index of its
/// placement. A warm start in the options is not used, because only one thread may use it. A limit
/// of steps applies to each query. The stop flag ends all queries with Error{interrupted}. Progress
/// reports give the fraction of the queries that are finished.
///
/// Errors      of all functions: those of the single query, for the first placement that has one;
///             the message begins with "placement N: ", with N counted from 0.
namespace abut {

/// The places of both models.
struct Placement {
    Transform world_from_a, world_from_b;
};

/// The motions of both models.
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
