#include "massive/work/model_cache.h"

#include "core/parallel.h"

#include <algorithm>
#include <utility>

namespace abut {

void ModelCache::make_room(std::uint32_t unit, std::uint64_t bytes, bool alone) {
    if (bytes_ + bytes <= budget_)
        return;
    struct Candidate {
        std::uint32_t use;
        std::int64_t mesh;
    };
    std::vector<Candidate> candidates;
    for (const auto& [mesh, entry] : entries_)
        if (entry.model != nullptr && entry.call + (alone ? 0 : 1) < call_)
            // A next use before the current unit was handed to another worker instead.
            candidates.push_back({entry.next_use >= unit ? entry.next_use : Task::kNoUse, mesh});
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.use != b.use ? a.use > b.use : a.mesh < b.mesh;
    });
    for (const Candidate& candidate : candidates) {
        if (bytes_ + bytes <= budget_)
            break;
        const auto entry = entries_.find(candidate.mesh);
        bytes_ -= entry->second.model->bytes();
        entries_.erase(entry);
    }
}

std::vector<const Model*> ModelCache::load(const Task& task) {
    ++call_;
    std::vector<std::pair<std::int64_t, Entry*>> missing;
    std::uint64_t bytes = 0;
    for (const Task::MeshUse& use : task.meshes) {
        Entry& entry = entries_[use.mesh]; // the address is stable
        entry.next_use = use.next_use;
        entry.call = call_;
        if (entry.model == nullptr) {
            missing.emplace_back(use.mesh, &entry);
            bytes += use.bytes;
        }
    }
    make_room(task.unit, bytes, std::exchange(was_alone_, task.alone) || task.alone);
    parallel_for(missing.size(), 1, [&](std::size_t i) {
        missing[i].second->model =
            std::make_unique<const Model>(reader_.read_mesh(missing[i].first));
    });
    for (const auto& [mesh, entry] : missing)
        bytes_ += entry->model->bytes();
    loads_ += missing.size();
    peak_bytes_ = std::max(peak_bytes_, bytes_);
    std::vector<const Model*> models;
    for (const Task::MeshUse& use : task.meshes)
        models.push_back(entries_.at(use.mesh).model.get());
    return models;
}

} // namespace abut
