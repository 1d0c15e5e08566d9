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
    generations_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box3 box = grown_by_half(boxes[i], margin);
        if (const std::uint32_t now = bodies_.bodies()[i].generation; generations_[i] != now) {
            broad_phase_.forget(); // another body had this index, with other rules
            generations_[i] = now;
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
}

} // namespace abut
