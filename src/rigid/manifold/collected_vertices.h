#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {

/// Vertices that a region has collected. It may forget some.
class CollectedVertices {
public:
    [[nodiscard]] bool has(std::uint32_t vertex) const { return kept_[vertex % kSize] == vertex; }
    void add(std::uint32_t vertex) { kept_[vertex % kSize] = vertex; }

private:
    static constexpr std::size_t kSize = 64;
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::array<std::uint32_t, kSize> kept_ = [] {
        std::array<std::uint32_t, kSize> none{};
        none.fill(kNone);
        return none;
    }();
};

} // namespace abut
