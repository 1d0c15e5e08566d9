#pragma once
#include <array>
namespace abut {
class OcclusionBuffer {
public:
    [[nodiscard]] bool hides(const std::array<float, 3>&, const std::array<float, 3>&) const {
        return false;
    }
};
} // namespace abut
