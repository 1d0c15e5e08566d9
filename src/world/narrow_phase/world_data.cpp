#include "world/narrow_phase/world_data.h"

#include <abut/error.h>

#include "world/narrow_phase/contact_rounding.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <string>
#include <utility>

namespace abut {

namespace {

/// Unlike ==, it tells 0 from -0.
bool has_same_bits(const Transform& a, const Transform& b) {
    return std::equal(a.m.begin(), a.m.end(), b.m.begin(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
}

std::uint32_t next_world_number() {
    static std::atomic<std::uint32_t> last = 0;
    std::uint32_t number = ++last;
    while (number == 0) // after 2^32 worlds
        number = ++last;
    return number;
}

} // namespace

WorldData::WorldData(WorldOptions options)
    : options_(std::move(options)), number_(next_world_number()),
      broad_phase_({options_.broad_phase,
                    [this](std::uint32_t i, std::uint32_t k) { return may_meet(i, k); }}) {}

BodyId WorldData::next_id() const {
    if (free_.empty())
        return {static_cast<std::uint32_t>(bodies_.size()), 0, number_};
    return {free_.back(), bodies_[free_.back()].generation + 1, number_};
}

bool WorldData::is_valid(BodyId id) const {
    return (id.world == number_ || id.world == 0) && id.index < bodies_.size() &&
           bodies_[id.index].alive && bodies_[id.index].owner == id.index &&
           bodies_[id.index].generation == id.generation;
}

void WorldData::require_valid(BodyId id) const {
    if (!is_valid(id)) {
        const bool is_other = id.world != 0 && id.world != number_;
        throw Error(ErrorCode::bad_argument,
                    "body " + std::to_string(id.index) +
                        (is_other ? ": is a body of another world" : ": there is no such body"));
    }
}
const Body& WorldData::body(BodyId id) const {
    require_valid(id);
    return bodies_[id.index];
}
Body& WorldData::changeable(BodyId id) {
    require_valid(id);
    return bodies_[id.index];
}

BodyId WorldData::add(BodyShape shape, const Pose& pose, const BodyOptions& options) {
    const Transform world_from_body = pose; // may throw, so nothing is changed before
    const std::uint32_t index = add_piece(std::move(shape), pose, world_from_body, options);
    ++alive_;
    return id_of(index);
}

BodyId WorldData::add(const std::vector<BodyShape>& pieces, const Pose& pose,
                      const BodyOptions& options) {
    const BodyId id = add(pieces.front(), pose, options);
    has_pieces_ = has_pieces_ || pieces.size() > 1;
    const Transform world_from_body = bodies_[id.index].world_from_body; // the list may move
    std::uint32_t last = id.index;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const std::uint32_t index = add_piece(pieces[i], pose, world_from_body, options);
        bodies_[index].owner = id.index, bodies_[index].piece = static_cast<std::uint32_t>(i);
        bodies_[index].next_piece = id.index;
        bodies_[last].next_piece = index;
        last = index;
    }
    return id;
}

std::uint32_t WorldData::add_piece(BodyShape shape, const Pose& pose,
                                   const Transform& world_from_body, const BodyOptions& options) {
    const BodyId id = next_id();
    if (free_.empty()) {
        bodies_.emplace_back();
        boxes_.emplace_back();
        is_changed_.push_back(0);
    } else {
        free_.pop_back();
    }
    Body& to = bodies_[id.index];
    to.own_bounds = bounds_of(shape);
    to.shape = std::move(shape);
    if (const auto* rounded = std::get_if<RoundedBox>(&to.shape))
        to.box_in_world = *rounded; // its sizes stay when it moves
    to.pose = pose, to.world_from_body = world_from_body;
    to.options = options;
    to.generation = id.generation, to.alive = true, to.seen = false;
    to.owner = to.next_piece = id.index, to.piece = 0;
    fit_box(id.index);
    return id.index;
}

void WorldData::remove(BodyId id) {
    require_valid(id);
    for_each_piece(id.index, [&](std::uint32_t index) {
        Body& gone = bodies_[index];
        gone.alive = false;
        gone.placement = ++last_placement_;
        gone.shape = RoundedBox();
        boxes_[index] = Box3();
        (gone.seen ? removed_ : free_).push_back(index);
        set_changed(index);
    });
    --alive_;
}

void WorldData::move(BodyId id, const Pose& pose) {
    require_valid(id);
    const Transform world_from_body = pose; // may throw, so nothing is changed before
    const bool stays = has_same_bits(bodies_[id.index].world_from_body, world_from_body);
    for_each_piece(id.index, [&](std::uint32_t index) {
        Body& moved = bodies_[index];
        moved.pose = pose;
        if (stays) {
            set_changed(index); // the next query counts as a step; box and placement stay
            return;
        }
        moved.world_from_body = world_from_body;
        fit_box(index);
    });
}

void WorldData::refresh(BodyId id) {
    Body& moved = changeable(id);
    auto* deformable = std::get_if<DeformableShape>(&moved.shape);
    if (deformable == nullptr)
        return;
    moved.shape = shape_of(deformable->surface);
    moved.own_bounds = bounds_of(moved.shape);
    ++moved.shape_version;
    fit_box(id.index);
}

void WorldData::set_options(BodyId id, const BodyOptions& options) {
    require_valid(id);
    for_each_piece(id.index, [&](std::uint32_t index) { bodies_[index].options = options; });
    refilter();
}

void WorldData::set_user_data(BodyId id, std::uint64_t user_data) {
    require_valid(id);
    for_each_piece(id.index,
                   [&](std::uint32_t index) { bodies_[index].options.user_data = user_data; });
}

void WorldData::refilter() {
    broad_phase_.forget();
    refiltered_ = true;
}

bool WorldData::may_meet(std::uint32_t i, std::uint32_t k) const {
    const BodyOptions &a = bodies_[i].options, &b = bodies_[k].options;
    if ((a.is_static && b.is_static) || (a.groups & b.mask) == 0 || (b.groups & a.mask) == 0 ||
        bodies_[i].owner == bodies_[k].owner)
        return false;
    const auto [first, second] = std::minmax({id_of(i), id_of(k)});
    return !options_.filter || options_.filter(first, second);
}

void WorldData::set_changed(std::uint32_t index) {
    if (is_changed_[index] == 0)
        changed_.push_back(index);
    is_changed_[index] = 1;
}

void WorldData::fit_box(std::uint32_t index) {
    Body& body = bodies_[index];
    body.placement = ++last_placement_;
    const auto* rounded = std::get_if<RoundedBox>(&body.shape);
    body.is_box = rounded != nullptr;
    if (body.is_box)
        place(body.box_in_world, *rounded, body.world_from_body);
    const Box3 box = body.is_box ? bounds_of(body.box_in_world)
                                 : bounds_of(body.shape, body.own_bounds, body.world_from_body);
    boxes_[index] = is_empty(box) ? box : grown(box, contact_share(body.shape, body.own_bounds));
    set_changed(index);
}

void WorldData::update() {
    broad_phase_.update(boxes_, changed_);
    pair_changes_.add(broad_phase_.begun(), broad_phase_.ended());
    // Without a query the changes would pile up. A pair that ended must not be taken for one that
    // has stayed, once another body has the index that becomes free here.
    if (pair_changes_.size() > warm_starts_.size() || !ended_.empty())
        static_cast<void>(warm_starts());
    for (const std::uint32_t index : changed_)
        is_changed_[index] = 0, bodies_[index].seen = true;
    changed_.clear();
    refiltered_ = false;
    free_.insert(free_.end(), ended_.begin(), ended_.end());
    ended_ = std::exchange(removed_, {});
}

std::vector<PairWarmStart>& WorldData::warm_starts() {
    if (!pair_changes_.empty()) {
        apply(pair_changes_.settle(), broad_phase_.pairs(), warm_starts_);
        pair_changes_.clear();
    }
    return warm_starts_;
}

void WorldData::update_if_changed() {
    if (refiltered_ || !changed_.empty())
        update();
}

} // namespace abut
