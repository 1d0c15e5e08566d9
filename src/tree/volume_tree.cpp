#include "tree/volume_tree.h"

#include "core/parallel.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// Triangles in depth-first order, so that those below any child form a contiguous run.
class SubtreeRuns {
public:
    struct Run {
        std::size_t begin = 0, count = 0;
    };

    SubtreeRuns(const Tree& tree, std::span<const Triangle> triangles)
        : tree_(tree), triangles_(triangles), runs_(tree.nodes.size()) {
        sorted_.reserve(triangles.size());
        walk(NodeRef::node(0));
    }

    [[nodiscard]] std::span<const Triangle> below(std::size_t node, std::size_t child) const {
        const Run& run = runs_[node][child];
        return std::span(sorted_).subspan(run.begin, run.count);
    }
    [[nodiscard]] std::span<const Triangle> all() const { return sorted_; }

private:
    Run walk(NodeRef ref) {
        Run run{sorted_.size(), 0};
        if (ref.is_leaf()) {
            for (std::uint32_t i = 0; i < ref.count(); ++i)
                sorted_.push_back(triangles_[tree_.order[ref.first() + i]]);
        } else {
            const Node& node = tree_.nodes[ref.index()];
            for (std::size_t i = 0; i < Node::kWidth; ++i)
                if (!node.child[i].is_none())
                    runs_[ref.index()][i] = walk(node.child[i]);
        }
        run.count = sorted_.size() - run.begin;
        return run;
    }

    const Tree& tree_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<Run, Node::kWidth>> runs_;
    std::vector<Triangle> sorted_;
};

template <typename V>
std::unique_ptr<const VolumeTree> build(Volume kind, const Tree& tree,
                                        std::span<const Triangle> triangles) {
    return std::make_unique<VolumeTree>(kind, VolumeLayer<V>(tree, triangles));
}

} // namespace

template <typename V>
VolumeLayer<V>::VolumeLayer(const Tree& tree, std::span<const Triangle> triangles)
    : children(tree.nodes.size()) {
    const SubtreeRuns runs(tree, triangles);
    root = V::fit(runs.all());
    std::vector<double> reaches(tree.nodes.size());
    parallel_for(tree.nodes.size(), 16, [&](std::size_t n) {
        for (std::size_t i = 0; i < Node::kWidth; ++i)
            if (!tree.nodes[n].child[i].is_none()) {
                const V volume = V::fit(runs.below(n, i));
                children[n].set(i, volume);
                reaches[n] = std::max(reaches[n], volume.reach());
            }
    });
    reach = root.reach();
    for (const double r : reaches)
        reach = std::max(reach, r);
}

double VolumeTree::reach() const {
    return std::visit([](const auto& layer) { return layer.reach; }, layer_);
}
std::size_t VolumeTree::bytes() const {
    return std::visit([](const auto& layer) { return layer.bytes(); }, layer_);
}

Volume common_volume(Volume a, Volume b) {
    const auto is_swept = [](Volume kind) {
        return kind == Volume::sphere || kind == Volume::pss || kind == Volume::lss ||
               kind == Volume::rss || kind == Volume::ssv;
    };
    if (a == b)
        return a;
    return is_swept(a) && is_swept(b) ? Volume::ssv : Volume::automatic;
}

std::unique_ptr<const VolumeTree> build_volume_tree(Volume kind, const Tree& tree,
                                                    const TreeMesh& mesh) {
    if (tree.empty() || kind == Volume::automatic || kind == Volume::aabb)
        return nullptr;
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        triangles.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    switch (kind) {
    case Volume::automatic:
    case Volume::aabb:
        return nullptr;
    case Volume::sphere:
        return build<BoundingSphere>(kind, tree, triangles);
    case Volume::kdop14:
        return build<Kdop14>(kind, tree, triangles);
    case Volume::kdop18:
        return build<Kdop18>(kind, tree, triangles);
    case Volume::kdop26:
        return build<Kdop26>(kind, tree, triangles);
    case Volume::obb:
        return build<Obb>(kind, tree, triangles);
    case Volume::pss:
        return build<Pss>(kind, tree, triangles);
    case Volume::lss:
        return build<Lss>(kind, tree, triangles);
    case Volume::rss:
        return build<Rss>(kind, tree, triangles);
    case Volume::ssv:
        return build<Ssv>(kind, tree, triangles);
    }
    return nullptr;
}

} // namespace abut
