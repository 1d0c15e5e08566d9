#include "rigid/model/model_blocks.h"

#include <abut/error.h>

#include "core/parallel.h"

namespace abut {

ModelBlocks::ModelBlocks(std::uint64_t triangles, std::vector<Box3> boxes, std::string folder,
                         std::size_t memory)
    : triangles_(triangles), boxes_(std::move(boxes)), folder_(std::move(folder)), memory_(memory) {
    if (boxes_.size() > std::size_t{1} << kBlockBits)
        throw Error(ErrorCode::unsupported,
                    "a mesh of " + std::to_string(triangles) + " triangles is too large");
}

const BlocksSolid& ModelBlocks::solid() const {
    // A thread that examines must not run other tasks meanwhile: they might ask for the same
    // result.
    std::call_once(once_,
                   [&] { isolated([&] { solid_ = examine_solid(*this, folder_, memory_); }); });
    return solid_;
}

} // namespace abut
