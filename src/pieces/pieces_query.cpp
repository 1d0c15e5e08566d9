#include "pieces/pieces_query.h"

#include "pieces/pieces_containment.h"

#include <utility>

namespace abut {

namespace {

BodyBall ball_of(const ConvexPiecesData& data) {
    const HullNode& root = data.tree.nodes[0];
    return {root.middle, root.radius};
}

} // namespace

PiecesQuery::PiecesQuery(const PlacedPieces& placed, PiecesWarmStart* warm_start,
                         PiecesCounters& counters)
    : placed_(placed), search_(placed, counters) {
    if (warm_start != nullptr) {
        last_ = &warm_start->data();
        recall();
    }
}

void PiecesQuery::recall() {
    const PosePair poses(placed_.world_from_a, placed_.world_from_b);
    if (last_->id_a != placed_.a.id || last_->id_b != placed_.b.id) {
        *last_ = {};
        last_->id_a = placed_.a.id, last_->id_b = placed_.b.id;
    } else {
        const double approach =
            most_approach(last_->poses, poses, ball_of(placed_.a), ball_of(placed_.b));
        last_->front.drift += approach;
        last_->undisturbed -= approach;
        // Bounds lose digits to a much larger drift. A drift that is not finite also ends the
        // front.
        constexpr double kLongest = 16;
        if (last_->front.worn || !(last_->front.drift <= kLongest * placed_.size()))
            last_->front = {};
    }
    last_->poses = poses;
}

bool PiecesQuery::run() {
    // A search that is stopped leaves no front, since pairs would be missing from it.
    PairFront front = last_ != nullptr ? std::exchange(last_->front, {}) : PairFront();
    const bool done =
        last_ != nullptr && last_->has_closest && search_.try_pair(last_->closest, last_->search);
    if (!done)
        search_.run(front, last_ != nullptr);
    if (last_ != nullptr)
        last_->front = std::move(front);
    const ClosestPieces& best = search_.best();
    if (last_ != nullptr && best.found) {
        last_->closest = best.hulls;
        last_->search = best.search;
        last_->has_closest = true;
    }
    return best.found;
}

std::optional<Vec3> PiecesQuery::contained_point(double apart) {
    if (last_ != nullptr && last_->undisturbed > 0 && last_->contained == false)
        return std::nullopt;
    const auto point = abut::contained_point(placed_);
    if (last_ != nullptr) {
        last_->undisturbed = apart;
        last_->contained = point.has_value();
    }
    return point;
}

Gap PiecesQuery::surface_gap(double bound) const {
    DistanceOptions options;
    options.warm_start = last_ != nullptr ? &last_->surfaces : nullptr;
    options.upper_bound = bound;
    return distance(placed_.a.model, placed_.world_from_a, placed_.b.model, placed_.world_from_b,
                    options);
}

std::optional<TrianglePair> PiecesQuery::touching_triangles() const {
    const Contacts contacts =
        collide(placed_.a.model, placed_.world_from_a, placed_.b.model, placed_.world_from_b,
                {.warm_start = last_ != nullptr ? &last_->surfaces : nullptr});
    return contacts.meet() ? std::optional(contacts.pairs[0]) : std::nullopt;
}

PiecesWarmStart::PiecesWarmStart() = default;
PiecesWarmStart::~PiecesWarmStart() = default;
PiecesWarmStart::PiecesWarmStart(PiecesWarmStart&&) noexcept = default;
PiecesWarmStart& PiecesWarmStart::operator=(PiecesWarmStart&&) noexcept = default;

PiecesWarmStart::Data& PiecesWarmStart::data() {
    if (!data_)
        data_ = std::make_unique<Data>();
    return *data_;
}

} // namespace abut
