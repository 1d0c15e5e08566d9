#pragma once

#include <abut/types.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut::scenes {

/// The occupied volume, as axis-aligned boxes in a hash grid. It keeps a scene free of clashes: a
/// part is placed only if its boxes keep the gap, on at least one axis, to all boxes placed before.
class Space {
public:
    static constexpr std::uint32_t kNobody = ~std::uint32_t{0};

    explicit Space(double gap) : gap_(gap) {}

    /// Whether a box keeps the gap to all reserved boxes other than those of the owner `except`.
    [[nodiscard]] bool free(const Box3& box, std::uint32_t except = kNobody) const;
    void reserve(const Box3& box, std::uint32_t owner);
    /// Removes reservations, the latest first, until `count` are left.
    void release_to(std::size_t count);
    [[nodiscard]] std::size_t size() const { return boxes_.size(); }

private:
    struct Taken {
        Box3 box;
        std::uint32_t owner;
    };
    double gap_;
    std::vector<Taken> boxes_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

} // namespace abut::scenes
