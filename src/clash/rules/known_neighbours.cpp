#include "clash/rules/known_neighbours.h"

#include <algorithm>

namespace abut {

namespace {

std::uint64_t key_of_pair(std::size_t i, std::size_t k) {
    return std::uint64_t{std::min(i, k)} << 32 | std::max(i, k);
}

Neighbours neighbours_of(RelationKind kind) {
    switch (kind) {
    case RelationKind::fills:
        return Neighbours::fills;
    case RelationKind::connected:
        return Neighbours::connected;
    case RelationKind::covers:
        return Neighbours::covers;
    case RelationKind::part_of:
        break;
    }
    return Neighbours::same_assembly;
}

} // namespace

void KnownNeighbours::add(const PartFacts& part) {
    const std::size_t number = parts_++;
    if (part.properties == nullptr)
        return;
    const auto name = part.properties->find("assembly");
    if (!name)
        return;
    const auto wholes = part.properties->of(part.part, *name);
    if (wholes.empty())
        return;
    // Wholes within one whole share the outermost one, which comes last.
    const std::string& outermost = part.properties->values[wholes.back().value];
    const auto whole =
        wholes_.try_emplace({part.model, outermost}, static_cast<std::uint32_t>(wholes_.size() + 1))
            .first->second;
    whole_of_.resize(number);
    whole_of_.push_back(whole);
}

void KnownNeighbours::add(std::span<const PartRelation> relations, std::size_t first) {
    for (const PartRelation& relation : relations)
        links_.push_back(
            {key_of_pair(first + relation.a, first + relation.b), neighbours_of(relation.kind)});
    std::ranges::sort(links_);
}

std::optional<Neighbours> KnownNeighbours::find(std::size_t i, std::size_t k) const {
    if (!links_.empty()) {
        const std::uint64_t pair = key_of_pair(i, k);
        const auto at = std::ranges::lower_bound(links_, pair, {}, &Link::pair);
        if (at != links_.end() && at->pair == pair)
            return at->neighbours;
    }
    if (i < whole_of_.size() && k < whole_of_.size() && whole_of_[i] != 0 &&
        whole_of_[i] == whole_of_[k])
        return Neighbours::same_assembly;
    return std::nullopt;
}

std::uint64_t KnownNeighbours::bytes() const {
    return links_.capacity() * sizeof(Link) + whole_of_.capacity() * sizeof(std::uint32_t);
}

} // namespace abut
