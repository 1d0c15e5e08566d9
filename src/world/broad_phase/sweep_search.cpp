#include "core/parallel.h"
#include "core/set_bits.h"
#include "math/vector.h"
#include "world/broad_phase/box_node.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace abut {

namespace {

/// The axis along which the boxes' centres have the largest variance. A centre that is not finite
/// counts as 0.
int widest_axis(std::span<const Box3> boxes) {
    std::array<double, 3> sum{}, sum_sq{};
    double count = 0;
    for (const Box3& box : boxes) {
        if (!takes_part(box))
            continue;
        ++count;
        for (int axis = 0; axis < 3; ++axis) {
            const double middle =
                0.5 * component(box.lower, axis) + 0.5 * component(box.upper, axis);
            if (!std::isfinite(middle))
                continue;
            sum[static_cast<std::size_t>(axis)] += middle;
            sum_sq[static_cast<std::size_t>(axis)] += middle * middle;
        }
    }
    std::array<double, 3> variance{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        variance[axis] = sum_sq[axis] - sum[axis] * sum[axis] / std::max(count, 1.0);
    return static_cast<int>(std::max_element(variance.begin(), variance.end()) - variance.begin());
}

/// Keeps boxes in the order in which they begin on one axis. Each box is compared with those that
/// begin before it ends, sixteen at a time. The order is kept from step to step.
/// Source      [Baraff 1992], one axis.
class SweepSearch final : public PairSearch {
public:
    explicit SweepSearch(PairFilter filter) : filter_(std::move(filter)) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        axis_ = widest_axis(boxes);
        order_.resize(boxes.size());
        std::iota(order_.begin(), order_.end(), 0);
        const auto begin = [&](std::uint32_t i) { return begin_of(boxes[i]); };
        std::sort(order_.begin(), order_.end(),
                  [&](std::uint32_t i, std::uint32_t k) { return begin(i) < begin(k); });
        find(boxes, list);
    }
    void update(const BoxStep& step, PairList& list) override {
        if (step.boxes.size() != order_.size() || !sort_again(step.boxes))
            restart(step.boxes, list);
        else
            find(step.boxes, list);
    }

private:
    static constexpr std::size_t kWidth = BoxNode::kWidth;

    /// The box's lower bound on the axis; empty boxes come last.
    [[nodiscard]] double begin_of(const Box3& box) const {
        return takes_part(box) ? component(box.lower, axis_)
                               : std::numeric_limits<double>::infinity();
    }

    /// Sorts by insertion. Returns false as soon as too much has changed places.
    bool sort_again(std::span<const Box3> boxes) {
        begins_.resize(order_.size());
        for (std::size_t i = 0; i < order_.size(); ++i)
            begins_[i] = begin_of(boxes[order_[i]]);
        std::size_t moves = 0;
        for (std::size_t i = 1; i < order_.size(); ++i) {
            const double begin = begins_[i];
            const std::uint32_t box = order_[i];
            std::size_t k = i;
            for (; k > 0 && begins_[k - 1] > begin; --k)
                begins_[k] = begins_[k - 1], order_[k] = order_[k - 1];
            begins_[k] = begin, order_[k] = box;
            moves += i - k;
            if (moves > 8 * order_.size())
                return false;
        }
        return true;
    }

    void find(std::span<const Box3> boxes, PairList& list) {
        const NarrowFrame frame;
        nodes_.resize((order_.size() + kWidth - 1) / kWidth);
        parallel_for(nodes_.size(), 256, [&](std::size_t node) {
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                const std::size_t at = node * kWidth + lane;
                nodes_[node].set(lane,
                                 at < order_.size() ? frame.narrow(boxes[order_[at]]) : Aabb());
            }
        });
        constexpr std::size_t kNodesOfTask = 4;
        const std::size_t tasks = (nodes_.size() + kNodesOfTask - 1) / kNodesOfTask;
        found_.resize(tasks);
        parallel_for(tasks, 1, [&](std::size_t task) {
            found_[task].clear();
            const std::size_t end = std::min(nodes_.size(), (task + 1) * kNodesOfTask);
            for (std::size_t node = task * kNodesOfTask; node < end; ++node)
                sweep(boxes, node, found_[task]);
        });
        list.replace_all(found_, boxes.size());
    }

    /// Compares a node with itself and with all nodes that begin before it ends.
    void sweep(std::span<const Box3> boxes, std::size_t node, std::vector<IndexPair>& found) const {
        const auto axis = static_cast<std::size_t>(axis_);
        const Aabb bounds = nodes_[node].bounds();
        for (std::size_t other = node; other < nodes_.size(); ++other) {
            if (nodes_[other].lower[axis][0] > bounds.upper[axis])
                return;
            BoxNodeMeetings meetings;
            find_meetings(nodes_[other], BoxNode::kAllLanes, nodes_[node], bounds, meetings);
            for (const std::uint32_t row : SetBits(meetings.rows)) {
                std::uint32_t meet = meetings.meet[row];
                if (other == node)
                    meet &= (1U << row) - 1;
                for (const std::uint32_t lane : SetBits(meet))
                    add(boxes, order_[other * kWidth + row], order_[node * kWidth + lane], found);
            }
        }
    }
    void add(std::span<const Box3> boxes, std::uint32_t i, std::uint32_t k,
             std::vector<IndexPair>& found) const {
        const IndexPair pair(i, k);
        if (meet(boxes[i], boxes[k]) && (!filter_ || filter_(pair.a(), pair.b())))
            found.push_back(pair);
    }

    PairFilter filter_;
    int axis_ = 0;
    std::vector<std::uint32_t> order_;
    std::vector<double> begins_;
    std::vector<BoxNode> nodes_;
    std::vector<std::vector<IndexPair>> found_;
};

} // namespace

std::unique_ptr<PairSearch> make_sweep_search(PairFilter filter) {
    return std::make_unique<SweepSearch>(std::move(filter));
}

} // namespace abut
