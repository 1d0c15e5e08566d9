#include "view/selection/occluder_set.h"

#include "view/selection/frustum.h"

#include <algorithm>

namespace abut {

namespace {

/// Smaller occluders hide nothing.
constexpr double kLeastCells = 16;
constexpr std::size_t kMostDrawn = 256, kMostCellsDrawn = 150'000;

std::uint64_t bytes_of(const std::vector<Occluder>& occluders) {
    std::uint64_t bytes = 128; // of the node of a map
    for (const Occluder& occluder : occluders)
        bytes += occluder.bytes();
    return bytes;
}

} // namespace

void OccluderSet::add(std::uint32_t chunk, std::vector<Occluder>&& occluders) {
    const std::uint64_t bytes = bytes_of(occluders);
    if (occluders.empty() || bytes_ + bytes > memory_)
        return;
    if (chunks_.try_emplace(chunk, std::move(occluders)).second)
        bytes_ += bytes;
}

void OccluderSet::remove(std::uint32_t chunk) {
    const auto found = chunks_.find(chunk);
    if (found == chunks_.end())
        return;
    bytes_ -= bytes_of(found->second);
    chunks_.erase(found);
}

void OccluderSet::draw(OcclusionBuffer& buffer, const Camera& camera, const Vec3& origin,
                       const std::vector<bool>& hidden) {
    buffer.begin(camera, origin);
    const Frustum frustum(CameraFrame(camera), camera.near, camera.far, origin);
    largest_.clear();
    for (const auto& [chunk, occluders] : chunks_)
        for (const Occluder& occluder : occluders) {
            const double cells = buffer.cells(occluder);
            if (cells >= kLeastCells && !hidden[occluder.part] &&
                frustum.may_see(occluder.lower, occluder.upper))
                largest_.emplace_back(std::min(cells, 1e9), &occluder);
        }
    const auto is_larger = [](const auto& a, const auto& b) {
        if (a.first != b.first)
            return a.first > b.first;
        return a.second->part != b.second->part ? a.second->part < b.second->part
                                                : a.second->lower < b.second->lower;
    };
    const std::size_t count = std::min(largest_.size(), kMostDrawn);
    std::partial_sort(largest_.begin(), largest_.begin() + static_cast<std::ptrdiff_t>(count),
                      largest_.end(), is_larger);
    std::size_t cells = 0;
    for (std::size_t i = 0; i < count && cells < kMostCellsDrawn; ++i)
        cells += buffer.draw(*largest_[i].second);
    buffer.finish();
}

} // namespace abut
