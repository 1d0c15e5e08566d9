#include "deform/triangle_boxes.h"
#include "deform/triangle_culling.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

constexpr std::size_t kBoxesOfTask = 512;

class SweepCulling final : public TriangleCulling {
public:
    SweepCulling(std::vector<TriangleBox> boxes, bool is_self)
        : boxes_(std::move(boxes)), is_self_(is_self), axis_(widest_axis()) {
        std::sort(boxes_.begin(), boxes_.end(), [&](const TriangleBox& a, const TriangleBox& b) {
            return a.box.lower[axis_] < b.box.lower[axis_];
        });
    }

    [[nodiscard]] std::size_t tasks() const override {
        return (boxes_.size() + kBoxesOfTask - 1) / kBoxesOfTask;
    }
    void run(std::size_t task, TrianglePairVisitor& visitor) const override {
        const std::size_t end = std::min((task + 1) * kBoxesOfTask, boxes_.size());
        for (std::size_t i = task * kBoxesOfTask; i < end; ++i)
            for (std::size_t k = i + 1;
                 k < boxes_.size() && boxes_[k].box.lower[axis_] <= boxes_[i].box.upper[axis_]; ++k)
                if (overlap(boxes_[i].box, boxes_[k].box) &&
                    !visit_pair(boxes_[i], boxes_[k], is_self_, visitor))
                    return;
    }

private:
    /// The axis on which the boxes' centres have the largest variance.
    [[nodiscard]] std::size_t widest_axis() const {
        std::array<double, 3> sum{}, sum_sq{};
        for (const TriangleBox& each : boxes_)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double middle =
                    0.5 * (double{each.box.lower[axis]} + double{each.box.upper[axis]});
                sum[axis] += middle;
                sum_sq[axis] += middle * middle;
            }
        const auto count = static_cast<double>(std::max<std::size_t>(boxes_.size(), 1));
        std::array<double, 3> variance{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            variance[axis] = sum_sq[axis] - sum[axis] * sum[axis] / count;
        return static_cast<std::size_t>(std::max_element(variance.begin(), variance.end()) -
                                        variance.begin());
    }

    std::vector<TriangleBox> boxes_;
    bool is_self_;
    std::size_t axis_;
};

} // namespace

std::unique_ptr<const TriangleCulling> make_sweep_culling(const DeformableData& a,
                                                          const DeformableData& b, float margin) {
    return std::make_unique<SweepCulling>(triangle_boxes(a, b, margin), &a == &b);
}

} // namespace abut
