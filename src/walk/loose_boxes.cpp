#include "walk/loose_boxes.h"

namespace abut {

void LooseBoxes::put(std::uint32_t entry, const Aabb& box) {
    const auto [at, is_new] =
        places_.try_emplace(entry, static_cast<std::uint32_t>(entries_.size()));
    if (is_new) {
        entries_.push_back(entry);
        boxes_.push_back(box);
        stale_ = true;
        return;
    }
    boxes_[at->second] = box;
    ++moves_;
    if (!stale_)
        tree_.set(lanes_[at->second], box);
}

void LooseBoxes::erase(std::uint32_t entry) {
    const auto at = places_.find(entry);
    if (at == places_.end())
        return;
    const std::uint32_t place = at->second;
    places_.erase(at);
    if (entries_[place] != entries_.back()) {
        entries_[place] = entries_.back();
        boxes_[place] = boxes_.back();
        places_[entries_[place]] = place;
    }
    entries_.pop_back();
    boxes_.pop_back();
    stale_ = true;
}

const BoxTree& LooseBoxes::tree() {
    if (stale_ || moves_ > boxes_.size()) {
        order_ = tree_.build(boxes_);
        lanes_.resize(order_.size());
        for (std::uint32_t lane = 0; lane < order_.size(); ++lane)
            lanes_[order_[lane]] = lane;
        moves_ = 0;
        stale_ = false;
    }
    return tree_;
}

} // namespace abut
