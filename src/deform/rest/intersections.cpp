#include <abut/deformable.h>

#include "core/parallel.h"
#include "core/stop.h"
#include "deform/deformable_data.h"
#include "deform/leaf_boxes.h"
#include "geometry/segment_triangle_contact.h"
#include "tree/traverse_overlaps.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace abut {

namespace {

/// Enough tasks that the longest one does not keep the other threads waiting.
constexpr std::size_t kIntersectionTasks = 512;
constexpr std::size_t kVerticesAtOnce = 8192;

/// A surface at one end of its step.
class SurfaceAtRest {
public:
    SurfaceAtRest(const DeformableData& surface, StepEnd end)
        : surface_(surface), end_(end), positions_(surface.vertices.size()) {
        parallel_for(positions_.size(), kVerticesAtOnce, [&](std::size_t i) {
            const MovingVertex& v = surface.vertices[i];
            positions_[i] = end == StepEnd::start ? v.start : v.end;
        });
    }

    [[nodiscard]] const DeformableData& surface() const { return surface_; }
    [[nodiscard]] StepEnd end() const { return end_; }
    [[nodiscard]] const std::array<std::uint32_t, 2>& edge(std::uint32_t id) const {
        return surface_.features.edges[id];
    }
    [[nodiscard]] const IndexTriangle& face(std::uint32_t id) const {
        return surface_.triangles[id];
    }
    [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
    [[nodiscard]] Triangle triangle(std::uint32_t id) const {
        const IndexTriangle& t = face(id);
        return {at(t[0]), at(t[1]), at(t[2])};
    }

private:
    const DeformableData& surface_;
    StepEnd end_;
    std::vector<Vec3> positions_;
};

/// Tests the edges that one of two leaves represents against the faces of the other. A leaf's box
/// encloses both, so that every pair that meets is found, and found once.
class EdgeFaceLeaves final : public OverlapVisitor {
public:
    EdgeFaceLeaves(const SurfaceAtRest& a, const SurfaceAtRest& b,
                   std::vector<EdgeFaceIntersection>& list)
        : a_(a), b_(b), source_a_(a.surface(), a.surface().swept),
          source_b_(b.surface(), b.surface().swept), leaves_a_(source_a_), leaves_b_(source_b_),
          is_self_(&a == &b), list_(list) {}

    bool visit(std::uint32_t i, std::uint32_t j) override {
        poll_stop();
        const bool same = is_self_ && i == j;
        auto& [edges_first, faces_first] = overlaps_;
        const LeafRuns leaf_a = leaves_a_.runs(i), leaf_b = leaves_b_.runs(j);
        edges_first.a = leaf_a.edges, edges_first.b = leaf_b.faces;
        faces_first.a = leaf_b.edges, faces_first.b = leaf_a.faces;
        find_overlaps_at(std::span(overlaps_).first(same ? 1 : 2), 0, a_.end());
        edges_first.for_each([&](auto edge, auto face) { test(a_, edge, b_, face, false); });
        if (!same)
            faces_first.for_each([&](auto edge, auto face) { test(b_, edge, a_, face, true); });
        return true;
    }

private:
    void test(const SurfaceAtRest& of_edge, std::uint32_t edge, const SurfaceAtRest& of_face,
              std::uint32_t face, bool face_first) {
        const auto& e = of_edge.edge(edge);
        const IndexTriangle& f = of_face.face(face);
        if (is_self_ && (e[0] == f[0] || e[0] == f[1] || e[0] == f[2] || e[1] == f[0] ||
                         e[1] == f[1] || e[1] == f[2]))
            return;
        const Vec3 &p = of_edge.at(e[0]), &q = of_edge.at(e[1]);
        const Triangle t = of_face.triangle(face);
        const SegmentContact contact = segment_triangle_contact(p, q, t);
        if (contact == SegmentContact::none)
            return;
        const SegmentPoint shared = segment_triangle_point(p, q, t);
        list_.push_back({face_first && !is_self_, edge, face,
                         contact == SegmentContact::cross   ? EdgeFaceContact::crossing
                         : contact == SegmentContact::touch ? EdgeFaceContact::touching
                                                            : EdgeFaceContact::coplanar,
                         shared.point, shared.along, shared.weights});
    }

    const SurfaceAtRest& a_;
    const SurfaceAtRest& b_;
    LeafSource source_a_, source_b_;
    LeafBoxes leaves_a_, leaves_b_;
    bool is_self_;
    std::vector<EdgeFaceIntersection>& list_;
    std::array<RunOverlaps, 2> overlaps_;
};

std::vector<EdgeFaceIntersection> find_intersections(const SurfaceAtRest& a,
                                                     const SurfaceAtRest& b) {
    OverlapTraversal traversal{a.surface().swept.tree, b.surface().swept.tree, 0, {}, a.end()};
    if (&a == &b)
        traversal.skipped = a.surface().flat_regions.flat();
    const std::vector<OverlapTraversal::Pair> starts =
        split_overlaps(traversal, kIntersectionTasks);
    std::vector<std::vector<EdgeFaceIntersection>> parts(starts.size());
    parallel_for(starts.size(), 1, [&](std::size_t i) {
        EdgeFaceLeaves visitor(a, b, parts[i]);
        traverse_overlaps(traversal, starts[i], visitor);
    });
    std::vector<EdgeFaceIntersection> all;
    for (const auto& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    const auto key = [](const EdgeFaceIntersection& i) {
        return std::tuple(i.face_first, i.edge, i.face);
    };
    std::sort(all.begin(), all.end(),
              [&](const EdgeFaceIntersection& i, const EdgeFaceIntersection& k) {
                  return key(i) < key(k);
              });
    return all;
}

StepEnd end_of(const IntersectionOptions& options) {
    return options.at_end ? StepEnd::end : StepEnd::start;
}

} // namespace

std::vector<EdgeFaceIntersection> self_intersections(const Deformable& surface,
                                                     const IntersectionOptions& options) {
    const StopScope stopping(options.progress);
    const SurfaceAtRest rest(surface.data(), end_of(options));
    return find_intersections(rest, rest);
}

std::vector<EdgeFaceIntersection> intersections(const Deformable& a, const Deformable& b,
                                                const IntersectionOptions& options) {
    if (&a == &b)
        return self_intersections(a, options);
    const StopScope stopping(options.progress);
    const SurfaceAtRest first(a.data(), end_of(options));
    const SurfaceAtRest second(b.data(), end_of(options));
    return find_intersections(first, second);
}

} // namespace abut
