#include "deform/triangle_boxes.h"
#include "deform/triangle_culling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {

namespace {

constexpr std::size_t kCellsOfTask = 1024;

/// A uniform grid with at most about as many cells as boxes.
class Cells {
public:
    using Index = std::array<std::size_t, 3>;

    explicit Cells(const std::vector<TriangleBox>& boxes) {
        Aabb all;
        double extent = 0;
        for (const TriangleBox& each : boxes) {
            all.merge(each.box);
            for (std::size_t axis = 0; axis < 3; ++axis)
                extent += double{each.box.upper[axis]} - double{each.box.lower[axis]};
        }
        if (boxes.empty())
            return;
        // The cell size is twice the boxes' mean size, or larger if that would make more cells than
        // boxes.
        const auto count = static_cast<double>(boxes.size());
        double size = std::max(2 * extent / (3 * count), std::numeric_limits<double>::min());
        for (double cells = 2 * count; cells > count; size *= 1.25) {
            cells = 1;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                lower_[axis] = all.lower[axis];
                const double along =
                    std::floor((double{all.upper[axis]} - double{all.lower[axis]}) / size) + 1;
                cells *= along;
                dimensions_[axis] = static_cast<std::size_t>(std::min(along, count + 1));
            }
            size_ = size;
        }
    }
    [[nodiscard]] std::size_t count() const {
        return dimensions_[0] * dimensions_[1] * dimensions_[2];
    }
    [[nodiscard]] Index at(const std::array<float, 3>& point) const {
        Index index{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            index[axis] = std::min(static_cast<std::size_t>(
                                       std::max(0.0, (double{point[axis]} - lower_[axis]) / size_)),
                                   dimensions_[axis] - 1);
        return index;
    }
    [[nodiscard]] std::size_t number(const Index& i) const {
        return (i[2] * dimensions_[1] + i[1]) * dimensions_[0] + i[0];
    }
    /// Calls visit(number) for the cells that a box touches.
    template <typename Visit>
    void for_each(const Aabb& box, const Visit& visit) const {
        const Index low = at(box.lower), high = at(box.upper);
        for (std::size_t z = low[2]; z <= high[2]; ++z)
            for (std::size_t y = low[1]; y <= high[1]; ++y)
                for (std::size_t x = low[0]; x <= high[0]; ++x)
                    visit(number({x, y, z}));
    }

private:
    std::array<double, 3> lower_{};
    double size_ = 1;
    Index dimensions_{1, 1, 1};
};

class GridCulling final : public TriangleCulling {
public:
    GridCulling(std::vector<TriangleBox> boxes, bool is_self)
        : boxes_(std::move(boxes)), is_self_(is_self), cells_(boxes_), begin_(cells_.count() + 1) {
        const auto for_each_entry = [&](const auto& visit) {
            for (std::uint32_t i = 0; i < boxes_.size(); ++i)
                cells_.for_each(boxes_[i].box, [&](std::size_t cell) { visit(cell, i); });
        };
        for_each_entry([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        entries_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for_each_entry([&](std::size_t cell, std::uint32_t i) { entries_[next[cell]++] = i; });
    }

    [[nodiscard]] std::size_t tasks() const override {
        return (cells_.count() + kCellsOfTask - 1) / kCellsOfTask;
    }
    void run(std::size_t task, TrianglePairVisitor& visitor) const override {
        const std::size_t end = std::min((task + 1) * kCellsOfTask, cells_.count());
        for (std::size_t cell = task * kCellsOfTask; cell < end; ++cell)
            if (!run_cell(cell, visitor))
                return;
    }

private:
    [[nodiscard]] bool run_cell(std::size_t cell, TrianglePairVisitor& visitor) const {
        for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i)
            for (std::size_t k = i + 1; k < begin_[cell + 1]; ++k) {
                const TriangleBox &a = boxes_[entries_[i]], &b = boxes_[entries_[k]];
                if (!overlap(a.box, b.box))
                    continue;
                std::array<float, 3> corner{};
                for (std::size_t axis = 0; axis < 3; ++axis)
                    corner[axis] = std::max(a.box.lower[axis], b.box.lower[axis]);
                if (cells_.number(cells_.at(corner)) == cell &&
                    !visit_pair(a, b, is_self_, visitor))
                    return false;
            }
        return true;
    }

    std::vector<TriangleBox> boxes_;
    bool is_self_;
    Cells cells_;
    std::vector<std::size_t> begin_; ///< index of each cell's first entry
    std::vector<std::uint32_t> entries_;
};

} // namespace

std::unique_ptr<const TriangleCulling> make_grid_culling(const DeformableData& a,
                                                         const DeformableData& b, float margin) {
    return std::make_unique<GridCulling>(triangle_boxes(a, b, margin), &a == &b);
}

} // namespace abut
