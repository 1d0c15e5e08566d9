#include "deform/leaf_boxes.h"

namespace abut {

namespace {

constexpr std::uint32_t kNoLeaf = ~std::uint32_t{0};
/// Leaf i is kept at place i modulo this.
constexpr std::size_t kPlaces = 256;

/// The vertices of a leaf's triangles, each once, with their boxes. All features of the leaf are
/// made of them.
class LeafVertices {
public:
    LeafVertices(const DeformableData& surface, const FeatureRuns& faces, std::uint32_t leaf) {
        for (std::uint32_t k = 0; k < faces.count(leaf); ++k)
            for (const std::uint32_t v : surface.triangles[faces.ids(leaf)[k]])
                if (place_of(v) == count_) {
                    const MovingVertex& vertex = surface.vertices[v];
                    ids_[count_] = v;
                    boxes_[count_++] = {box_at(vertex.start), box_at(vertex.end)};
                }
    }

    [[nodiscard]] const MovingBox& box(std::uint32_t vertex) const {
        return boxes_[place_of(vertex)];
    }
    template <std::size_t n>
    [[nodiscard]] MovingBox box(const std::array<std::uint32_t, n>& vertices) const {
        MovingBox box = this->box(vertices[0]);
        for (std::size_t i = 1; i < n; ++i) {
            const MovingBox& other = this->box(vertices[i]);
            box.start.merge(other.start);
            box.end.merge(other.end);
        }
        return box;
    }

private:
    static Aabb box_at(const Vec3& p) { return Aabb(Box3{p, p}); }
    [[nodiscard]] std::size_t place_of(std::uint32_t vertex) const {
        std::size_t i = 0;
        while (i < count_ && ids_[i] != vertex)
            ++i;
        return i;
    }

    static constexpr std::size_t kMost = 3 * TriangleLeaf::kLanes;
    std::array<std::uint32_t, kMost> ids_{};
    std::array<MovingBox, kMost> boxes_;
    std::size_t count_ = 0;
};

/// Writes the boxes of a leaf's features of one kind. Returns where the next run begins.
template <typename BoxOf>
float* write_run(const FeatureRuns& runs, std::uint32_t leaf, float* rows, const BoxOf& box_of) {
    const std::uint32_t count = runs.count(leaf);
    for (std::uint32_t k = 0; k < count; ++k) {
        const MovingBox& box = box_of(runs.ids(leaf)[k]);
        for (const StepEnd end : kStepEnds)
            set_bounds(rows + first_bound(end, count, k), count, box.at(end));
    }
    return rows + MovingBoxRun::kRows * count;
}

} // namespace

LeafSource::Fitted LeafSource::take() const {
    if (swept_.leaves.has_boxes())
        return nullptr;
    {
        const std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            Fitted fitted = std::move(idle_.back());
            idle_.pop_back();
            return fitted;
        }
    }
    auto fitted = std::make_unique_for_overwrite<FittedLeaf[]>(kPlaces);
    for (std::size_t i = 0; i < kPlaces; ++i)
        fitted[i].leaf = kNoLeaf;
    return fitted;
}

void LeafSource::give_back(Fitted fitted) const {
    if (fitted == nullptr)
        return;
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(fitted));
}

LeafRuns LeafBoxes::fitted_runs(std::uint32_t leaf) {
    FittedLeaf& fitted = fitted_[leaf % kPlaces];
    if (fitted.leaf != leaf)
        fit(leaf, fitted);
    const LeafFeatures& leaves = source_.swept().leaves;
    const float* rows = fitted.rows.data();
    const auto next = [&](const FeatureRuns& runs) {
        const MovingBoxRun run{rows, runs.ids(leaf), runs.count(leaf)};
        rows += MovingBoxRun::kRows * run.count;
        return run;
    };
    LeafRuns all;
    all.faces = next(leaves.faces);
    all.edges = next(leaves.edges);
    all.vertices = next(leaves.vertices);
    return all;
}

void LeafBoxes::fit(std::uint32_t leaf, FittedLeaf& fitted) const {
    const DeformableData& surface = source_.surface();
    const LeafFeatures& leaves = source_.swept().leaves;
    const LeafVertices vertices(surface, leaves.faces, leaf);
    float* rows = write_run(leaves.faces, leaf, fitted.rows.data(),
                            [&](std::uint32_t id) { return vertices.box(surface.triangles[id]); });
    rows = write_run(leaves.edges, leaf, rows,
                     [&](std::uint32_t id) { return vertices.box(surface.features.edges[id]); });
    write_run(leaves.vertices, leaf, rows, [&](std::uint32_t id) { return vertices.box(id); });
    fitted.leaf = leaf;
}

Aabb box_of_leaf(const LeafFeatures& leaves, std::uint32_t leaf, const SurfaceView& surface,
                 std::span<const Aabb> vertex_boxes) {
    Aabb all;
    for (std::uint32_t k = 0; k < leaves.faces.count(leaf); ++k)
        all.merge(box_of(surface.triangles[leaves.faces.ids(leaf)[k]], vertex_boxes));
    return all;
}

} // namespace abut
