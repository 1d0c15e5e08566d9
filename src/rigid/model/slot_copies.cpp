#include "rigid/model/slot_copies.h"

#include "rigid/model/model_data.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace abut {

namespace {

std::vector<bool> find_copies(const ModelData& model) {
    const auto slots = static_cast<std::uint32_t>(model.tree().order.size());
    std::vector<std::uint32_t> order(slots);
    std::iota(order.begin(), order.end(), 0U);
    const auto corner = [&](std::uint32_t slot, std::size_t k) {
        const Vec3& p =
            model.mesh().positions[model.mesh().triangles[model.triangle_at(slot)].at(k)];
        return std::tuple(p.x, p.y, p.z);
    };
    const auto compare = [&](std::uint32_t s, std::uint32_t t) {
        for (std::size_t k = 0; k < 3; ++k)
            if (corner(s, k) != corner(t, k))
                return corner(s, k) < corner(t, k) ? -1 : 1;
        return 0;
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t s, std::uint32_t t) {
        const int sign = compare(s, t);
        return sign < 0 || (sign == 0 && model.triangle_at(s) < model.triangle_at(t));
    });
    std::vector<bool> copies;
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (compare(order[i - 1], order[i]) != 0)
            continue;
        copies.resize(slots);
        copies[order[i]] = true;
    }
    return copies;
}

} // namespace

const std::vector<bool>& LazySlotCopies::of(const ModelData& model) const {
    std::call_once(once_, [&] { copies_ = find_copies(model); });
    return copies_;
}

} // namespace abut
