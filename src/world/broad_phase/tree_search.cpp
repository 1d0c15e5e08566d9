#include "core/parallel.h"
#include "core/set_bits.h"
#include "world/broad_phase/moving_box_tree.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// Two nodes of one level. The first does not come after the second.
struct BoxNodePair {
    std::uint32_t a, b;
};

/// Collects the pairs of one task that have a marked box.
class MarkedPairs {
public:
    MarkedPairs(const MovingBoxTree& tree, std::span<const Box3> boxes, const PairFilter& filter,
                std::vector<IndexPair>& found)
        : tree_(tree), boxes_(boxes), filter_(filter), found_(found) {}

    void visit(std::size_t level, BoxNodePair pair) {
        if (level == 0) {
            visit_boxes(pair);
            return;
        }
        for_each_child_pair(tree_, level, pair,
                            [&](BoxNodePair child) { visit(level - 1, child); });
    }

    /// Calls visit(children) for each pair of nodes of the level below that meet and have a mark.
    template <typename Visit>
    static void for_each_child_pair(const MovingBoxTree& tree, std::size_t level, BoxNodePair pair,
                                    const Visit& visit) {
        BoxNodeMeetings meetings;
        find(tree, level, pair, meetings);
        for (const std::uint32_t row : SetBits(meetings.rows)) {
            std::uint32_t meet = meetings.meet[row] & marked_partners(tree, level, pair, row);
            if (pair.a == pair.b)
                meet &= BoxNode::kAllLanes << row;
            for (const std::uint32_t lane : SetBits(meet))
                visit(BoxNodePair{pair.a * kWidth + row, pair.b * kWidth + lane});
        }
    }

private:
    static constexpr auto kWidth = static_cast<std::uint32_t>(MovingBoxTree::kWidth);

    static void find(const MovingBoxTree& tree, std::size_t level, BoxNodePair pair,
                     BoxNodeMeetings& meetings) {
        const std::vector<BoxNode>& nodes = tree.levels()[level];
        const std::vector<std::uint32_t>& marks = tree.marks(level);
        // If no box of b has changed, only the changed boxes of a need testing.
        const std::uint32_t rows = marks[pair.b] != 0 ? BoxNode::kAllLanes : marks[pair.a];
        const Aabb bounds = level + 1 < tree.levels().count()
                                ? tree.levels()[level + 1][pair.b / kWidth].box(pair.b % kWidth)
                                : nodes[pair.b].bounds();
        find_meetings(nodes[pair.a], rows, nodes[pair.b], bounds, meetings);
    }
    static std::uint32_t marked_partners(const MovingBoxTree& tree, std::size_t level,
                                         BoxNodePair pair, std::uint32_t row) {
        const std::vector<std::uint32_t>& marks = tree.marks(level);
        return (marks[pair.a] >> row & 1) != 0 ? BoxNode::kAllLanes : marks[pair.b];
    }

    void visit_boxes(BoxNodePair pair) {
        BoxNodeMeetings meetings;
        find(tree_, 0, pair, meetings);
        std::size_t count = 0;
        for (const std::uint32_t row : SetBits(meetings.rows)) {
            std::uint32_t meet = meetings.meet[row] & marked_partners(tree_, 0, pair, row);
            if (pair.a == pair.b)
                meet &= BoxNode::kAllLanes << row << 1;
            for (const std::uint32_t lane : SetBits(meet)) {
                const std::uint32_t i = tree_.box_at(pair.a, row), k = tree_.box_at(pair.b, lane);
                const bool certain = (meetings.touch[row] >> lane & 1) == 0;
                if (certain || meet_exactly(i, k))
                    pairs_[count++] = IndexPair(i, k);
            }
        }
        keep_wanted(std::span(pairs_).first(count));
    }
    [[nodiscard]] bool meet_exactly(std::uint32_t i, std::uint32_t k) const {
        return abut::meet(boxes_[i], boxes_[k]);
    }
    void keep_wanted(std::span<const IndexPair> pairs) {
        if (!filter_)
            found_.insert(found_.end(), pairs.begin(), pairs.end());
        else
            std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(found_),
                         [&](IndexPair pair) { return filter_(pair.a(), pair.b()); });
    }

    const MovingBoxTree& tree_;
    std::span<const Box3> boxes_;
    const PairFilter& filter_;
    std::vector<IndexPair>& found_;
    std::array<IndexPair, std::size_t{kWidth} * kWidth>
        pairs_; ///< pairs of two nodes, before the filter
};

class TreeSearch final : public PairSearch {
public:
    explicit TreeSearch(PairFilter filter) : filter_(std::move(filter)) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        is_last_current_ = false;
        tree_.build(boxes);
        find(boxes);
        list.replace_all(found_, boxes.size());
    }

    void update(const BoxStep& step, PairList& list) override {
        if (step.few_changed() && is_last_current_ && last_.size() == step.boxes.size()) {
            update_few(step, list);
            return;
        }
        update_marked(step, list);
        is_last_current_ = step.few_changed();
        if (is_last_current_)
            last_.assign(step.boxes.begin(), step.boxes.end());
    }

private:
    /// Moves the changed boxes one after the other. Each move finds the pairs that begin and end
    /// with it, while the other boxes stand still.
    void update_few(const BoxStep& step, PairList& list) {
        moves_.clear();
        for (const std::uint32_t i : step.changed) {
            const Box3 before = last_[i], now = step.boxes[i];
            lanes_.clear();
            tree_.move(i, before, now, lanes_);
            for (const std::size_t lane : lanes_) {
                const std::uint32_t k = tree_.box_at(lane);
                if (k == i)
                    continue;
                const bool met = have_common_point(before, last_[k]),
                           meets = have_common_point(now, last_[k]);
                if (met != meets)
                    moves_.add(IndexPair(i, k), meets);
            }
            last_[i] = now;
        }
        std::vector<IndexPair> begun, ended;
        for (const PairChanges::Change& change : moves_.settle())
            if (!filter_ || filter_(change.pair.a(), change.pair.b()))
                (change.by > 0 ? begun : ended).push_back(change.pair);
        list.change(std::move(begun), std::move(ended));
        if (tree_.is_worn())
            tree_.build(step.boxes);
    }

    void update_marked(const BoxStep& step, PairList& list) {
        const bool shrunk = step.boxes.size() < tree_.size();
        if (!shrunk)
            tree_.refit(step.boxes, step.changed);
        if (shrunk || tree_.is_worn() || tree_.size() == 0) {
            restart(step.boxes, list);
            return;
        }
        find(step.boxes);
        if (step.all_changed()) {
            list.replace_all(found_, step.boxes.size());
            return;
        }
        marks_.assign(step.boxes.size(), 0);
        for (const std::uint32_t box : step.changed)
            marks_[box] = 1;
        list.replace_marked(found_, marks_);
    }

    /// Collects the pairs of marked boxes.
    void find(std::span<const Box3> boxes) {
        constexpr std::size_t kPairsOfTask = 16;
        const std::size_t level = tree_.levels().count() > 1 ? 1 : 0;
        const std::vector<BoxNodePair> pairs = node_pairs(level);
        const std::size_t tasks = (pairs.size() + kPairsOfTask - 1) / kPairsOfTask;
        found_.resize(std::max<std::size_t>(tasks, 1));
        for (auto& list : found_)
            list.clear();
        parallel_for(tasks, 1, [&](std::size_t task) {
            MarkedPairs marked(tree_, boxes, filter_, found_[task]);
            const std::size_t end = std::min(pairs.size(), (task + 1) * kPairsOfTask);
            for (std::size_t i = task * kPairsOfTask; i < end; ++i)
                marked.visit(level, pairs[i]);
        });
    }

    /// Pairs of nodes of a level that meet and have a mark.
    [[nodiscard]] std::vector<BoxNodePair> node_pairs(std::size_t level) const {
        std::vector<BoxNodePair> pairs{{0, 0}}, children;
        for (std::size_t above = tree_.levels().count() - 1; above > level; --above) {
            children.clear();
            for (const BoxNodePair pair : pairs)
                MarkedPairs::for_each_child_pair(
                    tree_, above, pair, [&](BoxNodePair child) { children.push_back(child); });
            std::swap(pairs, children);
        }
        return pairs;
    }

    PairFilter filter_;
    MovingBoxTree tree_;
    std::vector<std::vector<IndexPair>> found_;
    BoxMarks marks_;
    /// The boxes of the last step, kept while few change from step to step.
    std::vector<Box3> last_;
    bool is_last_current_ = false;
    PairChanges moves_;              ///< of the boxes that change in a step
    std::vector<std::size_t> lanes_; ///< scratch
};

} // namespace

std::unique_ptr<PairSearch> make_tree_search(PairFilter filter) {
    return std::make_unique<TreeSearch>(std::move(filter));
}

} // namespace abut
