#include "massive/model_cache.h"

#include "core/parallel.h"

#include <algorithm>

namespace abut {

ModelCache::ModelCache(StoreFile& store, std::span<const StoredMesh> meshes,
                       std::span<const WorkUnit> units, std::uint64_t budget)
    : store_(store), meshes_(meshes), units_(units), budget_(budget), models_(meshes.size()),
      first_use_(meshes.size() + 1) {
    for (const WorkUnit& unit : units)
        for (const std::uint32_t mesh : unit.meshes)
            ++first_use_[mesh + 1];
    for (std::size_t i = 1; i < first_use_.size(); ++i)
        first_use_[i] += first_use_[i - 1];
    uses_.resize(first_use_.back());
    std::vector<std::uint32_t> next(first_use_.begin(), first_use_.end() - 1);
    for (std::uint32_t u = 0; u < units.size(); ++u)
        for (const std::uint32_t mesh : units[u].meshes)
            uses_[next[mesh]++] = u;
}

std::uint32_t ModelCache::next_use(std::uint32_t mesh, std::size_t from) const {
    const auto begin = uses_.begin() + first_use_[mesh], end = uses_.begin() + first_use_[mesh + 1];
    const auto use = std::lower_bound(begin, end, static_cast<std::uint32_t>(from));
    return use == end ? static_cast<std::uint32_t>(units_.size()) : *use;
}

void ModelCache::make_room(std::size_t unit, std::uint64_t bytes) {
    if (bytes_ + bytes <= budget_)
        return;
    // Those of this unit and of the one before stay, unless either is to be alone. The latest used
    // goes first.
    struct Candidate {
        std::uint32_t use, mesh;
    };
    std::vector<Candidate> candidates;
    const bool with_before = unit > 0 && !units_[unit - 1].alone && !units_[unit].alone;
    const auto& before = units_[with_before ? unit - 1 : unit].meshes;
    for (const std::uint32_t mesh : resident_)
        if (!std::binary_search(before.begin(), before.end(), mesh) && next_use(mesh, unit) != unit)
            candidates.push_back({next_use(mesh, unit), mesh});
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.use != b.use ? a.use > b.use : a.mesh < b.mesh;
    });
    for (const Candidate& candidate : candidates) {
        if (bytes_ + bytes <= budget_)
            break;
        bytes_ -= models_[candidate.mesh]->bytes();
        models_[candidate.mesh].reset();
    }
    resident_.erase(std::remove_if(resident_.begin(), resident_.end(),
                                   [&](std::uint32_t mesh) { return !models_[mesh]; }),
                    resident_.end());
}

void ModelCache::load(std::size_t unit) {
    std::vector<std::uint32_t> missing;
    std::uint64_t bytes = 0;
    for (const std::uint32_t mesh : units_[unit].meshes)
        if (!models_[mesh]) {
            missing.push_back(mesh);
            bytes += meshes_[mesh].bytes;
        }
    make_room(unit, bytes);
    parallel_for(missing.size(), 1, [&](std::size_t i) {
        models_[missing[i]].emplace(store_.read_mesh(meshes_[missing[i]].mesh));
    });
    for (const std::uint32_t mesh : missing)
        bytes_ += models_[mesh]->bytes();
    resident_.insert(resident_.end(), missing.begin(), missing.end());
    loads_ += missing.size();
    peak_bytes_ = std::max(peak_bytes_, bytes_);
}

} // namespace abut
