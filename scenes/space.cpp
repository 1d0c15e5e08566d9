#include "scenes/space.h"

#include "scenes/random.h"

#include <cmath>

namespace abut::scenes {
namespace {

constexpr double kCell = 2;

/// Calls `visit(key)` for each cell that the box meets. Stops when it returns false.
template <class Visit>
bool for_cells(const Box3& box, double margin, Visit visit) {
    const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell)); };
    const std::int64_t x1 = cell(box.upper.x + margin), y1 = cell(box.upper.y + margin),
                       z1 = cell(box.upper.z + margin);
    for (std::int64_t x = cell(box.lower.x - margin); x <= x1; ++x) {
        for (std::int64_t y = cell(box.lower.y - margin); y <= y1; ++y) {
            for (std::int64_t z = cell(box.lower.z - margin); z <= z1; ++z) {
                constexpr std::int64_t kHalf = std::int64_t{1} << 20;
                const auto key =
                    static_cast<std::uint64_t>((x + kHalf) << 42 | (y + kHalf) << 21 | (z + kHalf));
                if (!visit(mix(key))) {
                    return false;
                }
            }
        }
    }
    return true;
}

bool apart(const Box3& a, const Box3& b, double gap) {
    return a.lower.x - b.upper.x >= gap || b.lower.x - a.upper.x >= gap ||
           a.lower.y - b.upper.y >= gap || b.lower.y - a.upper.y >= gap ||
           a.lower.z - b.upper.z >= gap || b.lower.z - a.upper.z >= gap;
}

} // namespace

bool Space::free(const Box3& box, std::uint32_t except) const {
    return for_cells(box, gap_, [&](std::uint64_t key) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end()) {
            return true;
        }
        for (const std::uint32_t index : cell->second) {
            const Taken& taken = boxes_[index];
            if (taken.owner != except && !apart(box, taken.box, gap_)) {
                return false;
            }
        }
        return true;
    });
}

void Space::reserve(const Box3& box, std::uint32_t owner) {
    const auto index = static_cast<std::uint32_t>(boxes_.size());
    boxes_.push_back({box, owner});
    for_cells(box, 0, [&](std::uint64_t key) {
        cells_[key].push_back(index);
        return true;
    });
}

void Space::release_to(std::size_t count) {
    while (boxes_.size() > count) {
        for_cells(boxes_.back().box, 0, [&](std::uint64_t key) {
            cells_[key].pop_back(); // the latest reservation is the last entry of each of its cells
            return true;
        });
        boxes_.pop_back();
    }
}

} // namespace abut::scenes
