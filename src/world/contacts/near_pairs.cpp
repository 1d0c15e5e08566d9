#include "world/contacts/near_pairs.h"

#include "math/vector.h"

#include <cmath>

namespace abut {

namespace {

/// The box, grown by half of the margin and by what rounding may take away from that. Sides may be
/// infinite.
Box3 grown_by_half(const Box3& box, double margin) {
    if (is_empty(box))
        return box;
    const auto by = [&](const Vec3& v) {
        const double half = 0.5 * margin * (1 + 0x1p-50);
        return Vec3{half + 0x1p-50 * std::abs(v.x), half + 0x1p-50 * std::abs(v.y),
                    half + 0x1p-50 * std::abs(v.z)};
    };
    return {box.lower - by(box.lower), box.upper + by(box.upper)};
}

} // namespace

NearPairs::NearPairs(const WorldData& bodies)
    : bodies_(bodies),
      broad_phase_({BroadPhaseMethod::automatic,
                    [this](std::uint32_t i, std::uint32_t k) { return bodies_.may_meet(i, k); }}) {}

void NearPairs::update(double margin) {
    const std::vector<Box3>& boxes = bodies_.boxes();
    changed_.clear();
    bool are_new = false; ///< whether another body has the index of an earlier one
    is_new_.assign(boxes.size(), 0);
    generations_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box3 box = grown_by_half(boxes[i], margin);
        if (const std::uint32_t now = bodies_.bodies()[i].generation; generations_[i] != now) {
            broad_phase_.forget(); // another body had this index, with other rules
            generations_[i] = now;
            is_new_[i] = 1, are_new = true;
        }
        if (i < boxes_.size() && boxes_[i] == box)
            continue;
        if (i == boxes_.size())
            boxes_.push_back(box);
        boxes_[i] = box;
        changed_.push_back(static_cast<std::uint32_t>(i));
    }
    broad_phase_.update(boxes_, changed_);
    if (!broad_phase_.begun().empty() || !broad_phase_.ended().empty())
        place_warm_starts();
    if (!are_new)
        return;
    // Such a pair may have been one before, so that it has not begun.
    for (std::size_t k = 0; k < places_.size(); ++k)
        if (const IndexPair pair = pairs()[k]; (is_new_[pair.a()] | is_new_[pair.b()]) != 0)
            warm_start(k) = {};
}

void NearPairs::place_warm_starts() {
    changes_.add(broad_phase_.begun(), broad_phase_.ended());
    apply(changes_.settle(), broad_phase_.pairs(), places_);
    changes_.clear();
    was_taken_.swap(is_taken_);
    is_taken_.assign(warm_starts_.size(), 0);
    for (const WarmStartPlace at : places_)
        if (at.place != WarmStartPlace::kNone)
            is_taken_[at.place] = 1;
    for (std::size_t i = 0; i < warm_starts_.size(); ++i)
        if (was_taken_[i] > is_taken_[i])
            warm_starts_[i] = {};
    std::size_t free = 0;
    for (WarmStartPlace& at : places_) {
        if (at.place != WarmStartPlace::kNone)
            continue;
        while (free < is_taken_.size() && is_taken_[free] != 0)
            ++free;
        if (free == is_taken_.size())
            warm_starts_.emplace_back(), is_taken_.push_back(0);
        is_taken_[free] = 1;
        at.place = static_cast<std::uint32_t>(free);
    }
}

} // namespace abut
