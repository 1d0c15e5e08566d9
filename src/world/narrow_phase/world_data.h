#pragma once

#include <abut/world.h>

#include "world/broad_phase/pair_changes.h"
#include "world/narrow_phase/body.h"
#include "world/narrow_phase/narrow_phase.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace abut {

/// A body of a world, or a free place for one.
struct Body {
    BodyShape shape = RoundedBox();
    Pose pose;
    Box3 own_bounds;
    Transform world_from_body; // from here on what queries of pairs read
    RoundedBox box_in_world;   ///< the shape in the world, if it is a box
    bool is_box = false;       ///< a ball and a capsule too
    BodyOptions options;
    std::uint32_t generation = 0;
    /// The body that this is a piece of, by index: itself, but for the second and later pieces of a compound.
    std::uint32_t owner = 0;
    std::uint32_t piece = 0;         ///< its number in the compound
    std::uint32_t next_piece = 0;    ///< by index; that of the owner for the last one
    std::uint32_t shape_version = 0; ///< how often the shape has been refreshed
    /// A number that no other body and no other placement of this body has had in this world.
    std::uint64_t placement = 0;
    bool alive = false;
    bool seen = false; ///< by an update, so that lists of pairs may refer to it
};

/// The bodies of a world and the data of their pairs. The world's queries work on these.
///
/// Each piece of a compound is a body here. The first one is the owner of all, and gives them its id.
class WorldData {
public:
    explicit WorldData(WorldOptions options);
    WorldData(const WorldData&) = delete;
    WorldData& operator=(const WorldData&) = delete;

    BodyId add(BodyShape shape, const Pose& pose, const BodyOptions& options);
    BodyId add(const std::vector<BodyShape>& pieces, const Pose& pose, const BodyOptions& options);
    void remove(BodyId id);
    void move(BodyId id, const Pose& pose);
    void refresh(BodyId id);
    void set_options(BodyId id, const BodyOptions& options);
    void set_user_data(BodyId id, std::uint64_t user_data);
    void refilter();

    /// The id that the next added body will have.
    [[nodiscard]] BodyId next_id() const;
    [[nodiscard]] bool is_valid(BodyId id) const;
    /// Errors      Error{bad_argument} if the id is not valid.
    [[nodiscard]] const Body& body(BodyId id) const;

    /// Calls visit(index) for each piece of a body.
    template <typename Visit>
    void for_each_piece(std::uint32_t owner, const Visit& visit) const {
        std::uint32_t index = owner;
        do {
            const std::uint32_t next = bodies_[index].next_piece;
            visit(index);
            index = next;
        } while (index != owner);
    }
    /// Whether there has ever been a compound.
    [[nodiscard]] bool has_pieces() const { return has_pieces_; }

    void update();
    /// Updates if anything has changed since the last update, so that each query sees the bodies as
    /// they are and a removed body's place becomes free whatever is asked.
    void update_if_changed();

    [[nodiscard]] std::size_t size() const { return alive_; }
    [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }
    [[nodiscard]] const BroadPhase& broad_phase() const { return broad_phase_; }
    /// A warm start for each pair of `broad_phase().pairs()`.
    /// Brings them up to date, so call it before the pairs are handed to threads.
    [[nodiscard]] std::vector<PairWarmStart>& warm_starts();
    /// Memory of the results of tasks, used again by the next query.
    struct ResultParts {
        std::vector<std::vector<BodyPair>> pairs;
        std::vector<std::vector<BodyGap>> gaps;
        std::vector<std::vector<ContactManifold>> manifolds;
        std::size_t manifolds_found = 0; ///< by the last query
    };
    [[nodiscard]] ResultParts& parts() { return parts_; }

    [[nodiscard]] PlacedBody placed(std::uint32_t index) const {
        const Body& body = bodies_[index];
        return {body.shape, body.world_from_body, body.is_box ? &body.box_in_world : nullptr};
    }
    [[nodiscard]] BodyId id_of(std::uint32_t index) const {
        const std::uint32_t owner = bodies_[index].owner;
        return {owner, bodies_[owner].generation, number_};
    }
    /// Numbers both bodies as they are placed now.
    [[nodiscard]] PlacementPair placements_of(IndexPair pair) const {
        return {bodies_[pair.a()].placement, bodies_[pair.b()].placement};
    }
    /// In the order of the pair; if one is a piece, b may come before a.
    [[nodiscard]] BodyPair ids_of(IndexPair pair) const {
        return {id_of(pair.a()), id_of(pair.b())};
    }
    /// The number of the latest placement of any body.
    [[nodiscard]] std::uint64_t last_placement() const { return last_placement_; }
    /// Whether options and filter allow the bodies to meet. In: i < k.
    [[nodiscard]] bool may_meet(std::uint32_t i, std::uint32_t k) const;

private:
    std::uint32_t add_piece(BodyShape shape, const Pose& pose, const Transform& world_from_body,
                            const BodyOptions& options);
    void require_valid(BodyId id) const;
    Body& changeable(BodyId id);
    void set_changed(std::uint32_t index);
    void fit_box(std::uint32_t index);

    WorldOptions options_;
    const std::uint32_t number_; ///< among the worlds of the process, from 1
    std::vector<Body> bodies_;
    std::vector<Box3> boxes_; ///< empty where there is no body
    std::vector<std::uint32_t> free_;
    /// Indices removed since the last update, and in the step before it. An index becomes free when
    /// no list of ended pairs can refer to it any more: at once if no update has seen the body.
    std::vector<std::uint32_t> removed_, ended_;
    std::vector<std::uint32_t> changed_; ///< changed since the last update, each once
    std::vector<std::uint8_t> is_changed_;
    std::uint64_t last_placement_ = 0;
    bool refiltered_ = false; ///< whether filters changed since the last update
    bool has_pieces_ = false;
    std::size_t alive_ = 0; ///< bodies, not pieces
    BroadPhase broad_phase_;
    std::vector<PairWarmStart> warm_starts_; ///< of the pairs before `pair_changes_`
    ResultParts parts_;
    PairChanges pair_changes_;
};

} // namespace abut
