#pragma once

#include "view/selection/occluder.h"
#include "view/selection/occlusion_buffer.h"

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut {

/// The occluders of the chunks that the renderer has.
class OccluderSet {
public:
    /// In          memory: bytes; chunks for which it has no room have no occluders.
    explicit OccluderSet(std::uint64_t memory) : memory_(memory) {}

    void add(std::uint32_t chunk, std::vector<Occluder>&& occluders);
    void remove(std::uint32_t chunk);
    [[nodiscard]] bool empty() const { return chunks_.empty(); }
    /// Draws those that cover most of the picture, the largest first, until a limit of work is
    /// reached.
    ///
    /// In          hidden: by part; these are left out.
    /// Cost        one to two milliseconds at most, and some nanoseconds for each occluder of the set.
    void draw(OcclusionBuffer& buffer, const Camera& camera, const Vec3& origin,
              const std::vector<bool>& hidden);

private:
    std::uint64_t memory_, bytes_ = 0;
    std::unordered_map<std::uint32_t, std::vector<Occluder>> chunks_;
    std::vector<std::pair<double, const Occluder*>> largest_; ///< cells
};

} // namespace abut
