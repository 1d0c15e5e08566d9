#include <abut/deformable.h>
#include <abut/error.h>

#include "core/parallel.h"
#include "deform/deformable_data.h"
#include "deform/feature_trees.h"
#include "deform/leaf_boxes.h"
#include "math/vector.h"
#include "mesh/topology.h"

#include <algorithm>
#include <string>
#include <utility>

namespace abut {

namespace {

/// The hierarchy is rebuilt once its looseness has grown by this factor since it was built.
constexpr double kMostLooseness = 1.3;
/// Vertices or triangles that a thread takes at once.
constexpr std::size_t kGrain = 4096;

std::vector<Aabb> swept_vertex_boxes(std::span<const MovingVertex> vertices) {
    std::vector<Aabb> boxes(vertices.size());
    parallel_for(vertices.size(), kGrain, [&](std::size_t i) {
        Box3 box;
        extend(box, vertices[i].start);
        extend(box, vertices[i].end);
        boxes[i] = Aabb(box);
    });
    return boxes;
}

std::vector<Aabb> swept_boxes(std::span<const IndexTriangle> triangles,
                              std::span<const MovingVertex> vertices) {
    std::vector<Aabb> boxes(triangles.size());
    parallel_for(triangles.size(), kGrain, [&](std::size_t i) {
        Box3 box;
        for (const std::uint32_t v : triangles[i]) {
            extend(box, vertices[v].start);
            extend(box, vertices[v].end);
        }
        boxes[i] = Aabb(box);
    });
    return boxes;
}

/// The vertices' boxes at one end of the step.
std::vector<Aabb> vertex_boxes(std::span<const MovingVertex> vertices, StepEnd end) {
    std::vector<Aabb> boxes(vertices.size());
    parallel_for(vertices.size(), kGrain, [&](std::size_t i) {
        const Vec3& p = end == StepEnd::start ? vertices[i].start : vertices[i].end;
        boxes[i] = Aabb(Box3{p, p});
    });
    return boxes;
}

/// The vertices' boxes at both ends of the step.
std::vector<MovingBox> moving_boxes(std::span<const MovingVertex> vertices) {
    std::vector<MovingBox> boxes(vertices.size());
    parallel_for(vertices.size(), kGrain, [&](std::size_t i) {
        const MovingVertex& v = vertices[i];
        boxes[i] = {Aabb(Box3{v.start, v.start}), Aabb(Box3{v.end, v.end})};
    });
    return boxes;
}

/// Fits the boxes of one end of the step to the positions there.
void fit_end(SweptTree& swept, const DeformableData& data, StepEnd end) {
    const SurfaceView surface = data.surface();
    const std::vector<Aabb> boxes = vertex_boxes(data.vertices, end);
    const bool has_boxes = swept.leaves.has_boxes();
    fit(swept.tree, end, [&](std::uint32_t leaf) {
        return has_boxes ? fit_leaf(swept.leaves, leaf, end, surface, boxes)
                         : box_of_leaf(swept.leaves, leaf, surface, boxes);
    });
}

/// Makes all boxes at the end those at the start.
void start_at_end(SweptTree& swept) {
    constexpr std::size_t kBoxesAtOnce = 1024;
    parallel_for(swept.tree.nodes.size(), kBoxesAtOnce, [&](std::size_t i) {
        auto& rows = swept.tree.nodes[i].rows;
        for (std::size_t row = 0; row < MovingBoxRun::kEnd; ++row)
            std::copy_n(rows[MovingBoxRun::kEnd + row], MovingNode::kWidth, rows[row]);
    });
    LeafFeatures& leaves = swept.leaves;
    if (!leaves.has_boxes())
        return;
    parallel_for(leaves.faces.leaves(), kBoxesAtOnce, [&](std::size_t i) {
        const auto leaf = static_cast<std::uint32_t>(i);
        for (FeatureRuns* runs : {&leaves.faces, &leaves.edges, &leaves.vertices})
            runs->start_at_end(leaf);
    });
}

/// Positions as three numbers each.
template <typename Number>
class Triples {
public:
    explicit Triples(std::span<const Number> numbers) : numbers_(numbers) {}
    [[nodiscard]] Vec3 operator[](std::size_t i) const {
        return {numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]};
    }
    [[nodiscard]] std::span<const Number> numbers() const { return numbers_; }

private:
    std::span<const Number> numbers_;
};

/// Errors      as Deformable::set_motion.
void require_fit(std::span<const Vec3> positions, std::size_t vertices) {
    if (positions.size() != vertices)
        throw Error(ErrorCode::bad_argument, std::to_string(positions.size()) + " positions for " +
                                                 std::to_string(vertices) + " vertices");
    require_valid_positions(positions);
}
template <typename Number>
void require_fit(const Triples<Number>& positions, std::size_t vertices) {
    const std::size_t size = positions.numbers().size();
    if (size != 3 * vertices)
        throw Error(ErrorCode::bad_argument, std::to_string(size) + " numbers for " +
                                                 std::to_string(vertices) +
                                                 " vertices: not three a vertex");
    for (std::size_t i = 0; i < vertices; ++i)
        require_valid_position(positions[i], i);
}

template <typename Positions>
void set_both_ends(DeformableData& d, const Positions& start, const Positions& end) {
    require_fit(start, d.vertices.size());
    require_fit(end, d.vertices.size());
    parallel_for(d.vertices.size(), kGrain, [&](std::size_t i) {
        d.vertices[i] = {start[i], end[i]};
    });
    d.refit(FirstBoxes::unknown);
}
/// Makes the ends of the last step the starts, without the boxes.
template <typename Positions>
void move_on(DeformableData& d, const Positions& end) {
    require_fit(end, d.vertices.size());
    parallel_for(d.vertices.size(), kGrain, [&](std::size_t i) {
        d.vertices[i] = {d.vertices[i].end, end[i]};
    });
}

} // namespace

DeformableData::DeformableData() = default;
DeformableData::~DeformableData() = default;

bool DeformableData::is_at_rest() const {
    return std::all_of(vertices.begin(), vertices.end(),
                       [](const MovingVertex& v) { return v.start == v.end; });
}

void DeformableData::find_edges_of_triangles() {
    if (features.edges_of.empty())
        features = make_surface_features(vertices.size(), triangles);
}

/// Releases memory before it allocates, so that the peak is no higher than the final size.
void DeformableData::build() {
    swept = SweptTree();
    flat_regions = FlatRegions();
    feature_trees.reset();
    feature_boxes.reset();
    rest_model.forget();
    find_edges_of_triangles();
    {
        const Tree shape = build_tree(swept_boxes(triangles, vertices));
        swept.tree = MovingTree(shape);
        swept.leaves = LeafFeatures(shape, surface(), represented);
    }
    flat_regions = FlatRegions(swept.tree, swept.leaves.faces, surface());
    if (searches_leaves() || options.scheme == Scheme::features)
        features.edges_of = std::vector<IndexTriangle>(); // `{}` would keep its memory
    if (!(options.lean && searches_leaves()))
        swept.leaves.allocate_boxes();
    if (options.scheme == Scheme::features)
        feature_trees = std::make_unique<FeatureTrees>(surface(), swept_vertex_boxes(vertices));
    fit_boxes(FirstBoxes::unknown);
    looseness_when_built_ = looseness();
}

void DeformableData::fit_boxes(FirstBoxes first) {
    if (first == FirstBoxes::last_ends)
        start_at_end(swept);
    else
        fit_end(swept, *this, StepEnd::start);
    fit_end(swept, *this, StepEnd::end);
    if (feature_trees)
        for (const StepEnd end : kStepEnds)
            feature_trees->fit(surface(), end, vertex_boxes(vertices, end));
    if (compares_boxes_of_pairs())
        feature_boxes =
            std::make_unique<FeatureBoxes>(moving_boxes(vertices), features.edges, triangles);
    flat_regions.fit(swept.leaves.faces, triangles, vertices);
}

void DeformableData::refit(FirstBoxes first) {
    rest_model.move_on();
    fit_boxes(first);
    if (looseness() > kMostLooseness * looseness_when_built_)
        build();
}

/// The box of the triangle at place k of a leaf.
MovingBox DeformableData::face_box(std::uint32_t leaf, std::uint32_t k) const {
    const FeatureRuns& faces = swept.leaves.faces;
    if (faces.has_boxes())
        return faces.box(leaf, k);
    Box3 start, end;
    for (const std::uint32_t v : triangles[faces.ids(leaf)[k]]) {
        extend(start, vertices[v].start);
        extend(end, vertices[v].end);
    }
    return {Aabb(start), Aabb(end)};
}

/// The mean ratio of a node's box to the boxes of its children, and of a leaf's box to those of its
/// triangles. Each ratio counts the same, so that neither motion nor a few large triangles outweigh
/// the shape of the hierarchy.
double DeformableData::looseness() const {
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](const MovingBox& outer, double inner) {
        const double area{outer.swept().half_area()};
        if (inner > 0) {
            sum += area / inner;
            ++count;
        }
    };
    for (const MovingNode& node : swept.tree.nodes) {
        double children = 0;
        for (std::uint32_t i = 0; i < MovingNode::kWidth && !node.child[i].is_none(); ++i) {
            const MovingBox box = moving_tree::box_of(node, i);
            children += double{box.swept().half_area()};
            if (!node.child[i].is_leaf())
                continue;
            const std::uint32_t leaf = leaf_number(node.child[i]);
            double faces = 0;
            for (std::uint32_t k = 0; k < swept.leaves.faces.count(leaf); ++k)
                faces += double{face_box(leaf, k).swept().half_area()};
            add(box, faces);
        }
        add(moving_tree::bounds_of(node), children);
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

Deformable::Deformable(Mesh mesh, const DeformableOptions& options)
    : data_(std::make_shared<DeformableData>()) {
    data_->options = options;
    set_mesh(std::move(mesh));
}
Deformable::~Deformable() = default;
Deformable::Deformable(Deformable&&) noexcept = default;
Deformable& Deformable::operator=(Deformable&&) noexcept = default;
Deformable::Deformable(std::shared_ptr<DeformableData> data) : data_(std::move(data)) {}

std::shared_ptr<const Deformable> shared(const Deformable& surface) {
    return std::shared_ptr<const Deformable>(new Deformable(surface.data_));
}

void Deformable::set_mesh(Mesh mesh) {
    require_valid(mesh);
    DeformableData& d = *data_;
    SurfaceFeatures features = make_surface_features(mesh.positions.size(), mesh.triangles);
    const SurfaceView surface{mesh.positions.size(), mesh.triangles, features};
    std::vector<Represented> represented;
    if (d.triangles.empty()) {
        represented = assign_features(surface, d.options.assignment);
    } else {
        represented.resize(mesh.triangles.size());
        for (std::size_t i = 0; i < std::min(represented.size(), d.triangles.size()); ++i)
            if (mesh.triangles[i] == d.triangles[i])
                represented[i] = d.represented[i];
        complete_assignment(surface, represented);
    }
    d.triangles = std::move(mesh.triangles);
    d.features = std::move(features);
    d.represented = std::move(represented);
    d.vertices.resize(mesh.positions.size());
    for (std::size_t i = 0; i < d.vertices.size(); ++i)
        d.vertices[i] = {mesh.positions[i], mesh.positions[i]};
    mesh = Mesh(); // frees the memory of the mesh before the hierarchy is built
    d.build();
}

void Deformable::set_motion(std::span<const Vec3> start, std::span<const Vec3> end) {
    set_both_ends(*data_, start, end);
}
void Deformable::set_motion(std::span<const double> start, std::span<const double> end) {
    set_both_ends(*data_, Triples(start), Triples(end));
}
void Deformable::set_motion(std::span<const float> start, std::span<const float> end) {
    set_both_ends(*data_, Triples(start), Triples(end));
}

void Deformable::advance(std::span<const Vec3> end) {
    move_on(*data_, end);
    data_->refit(FirstBoxes::last_ends);
}
void Deformable::advance(std::span<const double> end) {
    move_on(*data_, Triples(end));
    data_->refit(FirstBoxes::last_ends);
}
void Deformable::advance(std::span<const float> end) {
    move_on(*data_, Triples(end));
    data_->refit(FirstBoxes::last_ends);
}
void Deformable::advance(std::vector<Vec3>&& end) {
    move_on(*data_, std::span<const Vec3>(end));
    std::vector<Vec3>().swap(end);
    data_->refit(FirstBoxes::last_ends);
}

void Deformable::adapt(const Impacts& impacts) {
    DeformableData& d = *data_;
    d.find_edges_of_triangles();
    std::vector<bool> marked(d.triangles.size());
    std::vector<bool> edges(d.features.edges.size());
    for (const FeatureImpact& impact : impacts.list)
        if (impact.kind == ElementaryKind::edge_edge)
            edges[impact.a] = edges[impact.b] = true;
        else
            marked[impact.b] = true;
    for (std::size_t i = 0; i < d.triangles.size(); ++i)
        for (const std::uint32_t edge : d.features.edges_of[i])
            if (edge != kNoEdge && edges[edge])
                marked[i] = true;
    move_features_off(d.surface(), marked, d.represented);
    d.build();
}

std::size_t Deformable::vertex_count() const noexcept {
    return data_->vertices.size();
}
const std::vector<std::array<std::uint32_t, 3>>& Deformable::triangles() const noexcept {
    return data_->triangles;
}
const std::vector<std::array<std::uint32_t, 2>>& Deformable::edges() const noexcept {
    return data_->features.edges;
}
Model Deformable::model() const {
    return data_->rest_model.of(*data_);
}
std::size_t Deformable::bytes() const noexcept {
    const DeformableData& d = *data_;
    return d.triangles.size() * sizeof(d.triangles[0]) +
           d.features.edges.size() * sizeof(d.features.edges[0]) +
           d.features.edges_of.size() * sizeof(d.features.edges_of[0]) + d.represented.size() +
           d.vertices.size() * sizeof(d.vertices[0]) + d.swept.tree.bytes() +
           d.swept.leaves.bytes() + d.flat_regions.bytes() + d.rest_model.bytes() +
           (d.feature_trees ? d.feature_trees->bytes() : 0) +
           (d.feature_boxes ? d.feature_boxes->bytes() : 0);
}

} // namespace abut
