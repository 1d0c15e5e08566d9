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
    changes_.add(broad_phase_.begun(), broad_phase_.ended());
    apply(changes_.settle(), broad_phase_.pairs(), warm_starts_);
    changes_.clear();
    if (!are_new)
        return;
    // Such a pair may have been one before, so that it has not begun.
    for (std::size_t k = 0; k < warm_starts_.size(); ++k)
        if (const IndexPair pair = pairs()[k]; (is_new_[pair.a()] | is_new_[pair.b()]) != 0)
            warm_starts_[k] = {};
}

} // namespace abut
