#pragma once

#include <cstdint>
#include <limits>

/// How a `World` names its bodies and pairs of them.
namespace abut {

/// Identifies a body of a world. Valid until the body is removed, and never valid again.
struct BodyId {
    /// Below World::index_end(), not World::size(): a compound takes an index for each of its pieces, of
    /// which its id has the first. Another body has the index after this one is removed.
    std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t generation = 0; ///< number of earlier bodies with this index
    /// Number of the world among those of the process; 0: not told, so any world takes the id. Two ids
    /// that differ only in this are equal, so that lists of worlds that were made alike are equal, too.
    std::uint32_t world = 0;
    friend bool operator==(const BodyId& a, const BodyId& b) {
        return a.index == b.index && a.generation == b.generation;
    }
    friend bool operator<(const BodyId& a, const BodyId& b) {
        return a.index != b.index ? a.index < b.index : a.generation < b.generation;
    }
};

/// Two bodies, with a.index < b.index.
struct BodyPair {
    BodyId a, b;
    friend bool operator==(const BodyPair&, const BodyPair&) = default;
    friend bool operator<(const BodyPair& p, const BodyPair& q) {
        return p.a == q.a ? p.b < q.b : p.a < q.a;
    }
};

} // namespace abut
