#include <abut/deformable.h>
#include <abut/error.h>

#include "ccd/feature_distance.h"
#include "core/parallel.h"
#include "deform/candidate_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// A sink of pairs (see FeaturePairs) that keeps those within a distance of each other at the
/// start.
class NearPairs {
public:
    NearPairs(const DeformableData& a, const DeformableData& b, double distance,
              std::vector<FeaturePair>& list)
        : edges_(a, b), vertex_face_(a, b), face_vertex_(b, a), distance_(distance), list_(list) {}

    void add(PairKind kind, FeatureIds ids, bool wanted) {
        if (!wanted)
            return;
        if (kind == PairKind::edges)
            keep(ElementaryKind::edge_edge, false, ids, edges_.vertices(ids));
        else if (kind == PairKind::vertex_face)
            keep(ElementaryKind::vertex_face, false, ids, vertex_face_.vertices(ids));
        else
            keep(ElementaryKind::vertex_face, true, ids, face_vertex_.vertices(ids));
    }
    static bool is_done() { return false; }

private:
    void keep(ElementaryKind kind, bool face_first, FeatureIds ids, const PairVertices& vertices) {
        const std::array points{vertices[0]->start, vertices[1]->start, vertices[2]->start,
                                vertices[3]->start};
        const FeatureDistance found = feature_distance(kind, points);
        if (are_within(kind, points, found, distance_))
            list_.push_back({kind, face_first, ids.a, ids.b, std::min(found.distance, distance_),
                             found.barycentric});
    }

    PairGeometry<ElementaryKind::edge_edge> edges_;
    PairGeometry<ElementaryKind::vertex_face> vertex_face_, face_vertex_;
    double distance_;
    std::vector<FeaturePair>& list_;
};

std::vector<FeaturePair> find_near(const DeformableData& a, const DeformableData& b,
                                   double distance, const Progress& progress) {
    if (!(distance >= 0 && std::isfinite(distance)))
        throw Error(ErrorCode::bad_argument, "the distance must be a finite number of at least 0");
    const StopScope stopping(progress);
    SweptTree rest_a = a.swept, rest_b;
    fit_at(rest_a, a, StepEnd::start);
    if (&a != &b) {
        rest_b = b.swept;
        fit_at(rest_b, b, StepEnd::start);
    }
    const CandidateSearch search(a, rest_a, b, &a == &b ? rest_a : rest_b, distance);
    std::vector<std::vector<FeaturePair>> parts(search.tasks());
    search.for_each_task([&](std::size_t i) {
        NearPairs sink(a, b, distance, parts[i]);
        search.run(i, sink);
    });
    std::vector<FeaturePair> all;
    for (const std::vector<FeaturePair>& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(),
              [](const FeaturePair& p, const FeaturePair& q) { return list_key(p) < list_key(q); });
    return all;
}

} // namespace

std::vector<FeaturePair> self_within(const Deformable& surface, double distance,
                                     const Progress& progress) {
    return find_near(surface.data(), surface.data(), distance, progress);
}
std::vector<FeaturePair> within(const Deformable& a, const Deformable& b, double distance,
                                const Progress& progress) {
    return find_near(a.data(), b.data(), distance, progress);
}

} // namespace abut
