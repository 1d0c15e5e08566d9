#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace abut {

/// Eight volumes in SIMD order: lane i of every row belongs to volume i. The rows are the volume's
/// members in order. All members are floats.
template <typename V>
struct alignas(32) VolumeBatch {
    static constexpr std::size_t kLanes = 8;
    float row[V::kFloats][kLanes] = {};

    void set(std::size_t lane, const V& volume) {
        static_assert(std::is_trivially_copyable_v<V> && sizeof(V) >= V::kFloats * sizeof(float));
        std::array<float, V::kFloats> values{};
        std::memcpy(values.data(), &volume, sizeof(values));
        for (std::size_t i = 0; i < V::kFloats; ++i)
            row[i][lane] = values[i];
    }
    [[nodiscard]] V get(std::size_t lane) const {
        std::array<float, V::kFloats> values{};
        for (std::size_t i = 0; i < V::kFloats; ++i)
            values[i] = row[i][lane];
        V volume;
        std::memcpy(static_cast<void*>(&volume), values.data(), sizeof(values));
        return volume;
    }
};

} // namespace abut
