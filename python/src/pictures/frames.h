#pragma once

#include <abut/view.h>

#include <cstdint>
#include <vector>

namespace abut::python {

/// A copy of the data that one frame draws: the frame itself is valid until the next one.
struct FrameCopy {
    std::vector<std::uint32_t> drops;
    std::vector<ChunkUpload> uploads;
    std::vector<ChunkDraw> draws;
    std::vector<ChunkInstance> instances;
    bool complete = false, loaded = false;
    double pixel_error = 0;

    /// Valid as long as the copy.
    [[nodiscard]] ViewFrame frame() const {
        return {drops, uploads, draws, instances, complete, loaded, pixel_error};
    }
};

} // namespace abut::python
