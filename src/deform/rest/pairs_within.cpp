#include <abut/deformable.h>

#include "ccd/feature_distance.h"
#include "ccd/near_filter.h"
#include "core/parallel.h"
#include "core/set_bits.h"
#include "core/stop.h"
#include "deform/candidate_search.h"
#include "deform/rest/feature_pair.h"
#include "deform/rest/near_rules.h"
#include "deform/rest/rest_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

namespace {

/// What all tasks of a query share.
struct NearQuery {
    const DeformableData& a;
    const DeformableData& b;
    double distance;
    const NearVertices& of_a;
    const NearVertices& of_b;
    StepEnd at;
};

/// The pairs of one kind: their positions, and which of them are to be listed.
template <ElementaryKind kind>
class PairsOfKind {
public:
    PairsOfKind(const NearQuery& q, bool face_first)
        : geometry_(face_first ? q.b : q.a, face_first ? q.a : q.b),
          rules_(face_first ? q.of_b : q.of_a, face_first ? q.of_a : q.of_b, q.distance),
          face_first_(face_first), at_(q.at) {}

    [[nodiscard]] std::array<Vec3, 4> points(FeatureIds ids) const {
        const PairVertices v = geometry_.vertices(ids);
        std::array<Vec3, 4> points;
        for (std::size_t i = 0; i < 4; ++i)
            points[i] = at_ == StepEnd::start ? v[i]->start : v[i]->end;
        return points;
    }
    [[nodiscard]] bool admit(FeatureIds ids) const {
        if (rules_.admit_all())
            return true;
        const auto vertices = geometry_.indices(ids);
        return rules_.admit(first(vertices), second(vertices));
    }
    [[nodiscard]] double limit(FeatureIds ids) const {
        const auto vertices = geometry_.indices(ids);
        return rules_.limit(first(vertices), second(vertices));
    }
    /// In: a pair that is near.
    [[nodiscard]] FeaturePair measured(FeatureIds ids) const {
        FeaturePair pair;
        pair.kind = kind;
        pair.face_first = face_first_;
        pair.a = ids.a, pair.b = ids.b;
        pair.vertices = geometry_.indices(ids);
        pair.limit = limit(ids);
        const std::array<Vec3, 4> at = points(ids);
        measure(pair, at, feature_distance(kind, at));
        return pair;
    }
    [[nodiscard]] std::uint64_t key(FeatureIds ids) const {
        FeaturePair pair;
        pair.kind = kind;
        pair.face_first = face_first_;
        pair.a = ids.a, pair.b = ids.b;
        return list_key(pair);
    }

private:
    /// How many of a pair's vertices belong to the first feature.
    static constexpr std::size_t kSplit = kind == ElementaryKind::edge_edge ? 2 : 1;
    using Vertices = std::array<std::uint32_t, 4>;
    static NearRules::Feature first(const Vertices& vertices) {
        return NearRules::Feature(vertices).first(kSplit);
    }
    static NearRules::Feature second(const Vertices& vertices) {
        return NearRules::Feature(vertices).subspan(kSplit);
    }

    PairGeometry<kind> geometry_;
    NearRules rules_;
    bool face_first_;
    StepEnd at_;
};

/// Tests pairs of one kind, eight at a time, and keeps the list keys of those that are near.
template <ElementaryKind kind>
class NearTests {
public:
    NearTests(const NearQuery& query, bool face_first, std::vector<std::uint64_t>& keys)
        : pairs_(query, face_first), keys_(keys) {}

    /// Without a branch on `wanted`, which is hard to predict.
    void add(FeatureIds ids, bool wanted) {
        items_[count_] = ids;
        count_ += wanted ? 1 : 0;
        if (count_ == NearBatch::kLanes)
            test();
    }
    void finish() {
        if (count_ > 0)
            test();
    }

private:
    void test() {
        std::uint32_t admitted = 0;
        for (std::uint32_t lane = 0; lane < count_; ++lane) {
            batch_.set(lane, pairs_.points(items_[lane]), pairs_.limit(items_[lane]));
            admitted |= std::uint32_t{pairs_.admit(items_[lane])} << lane;
        }
        count_ = 0;
        if (admitted == 0)
            return;
        const NearBits bits = near_filter(batch_, kind);
        for (const std::uint32_t lane : SetBits(bits.possible & admitted))
            if ((bits.certain >> lane & 1) != 0 || is_near(items_[lane], batch_.limit[lane]))
                keys_.push_back(pairs_.key(items_[lane]));
    }
    [[nodiscard]] bool is_near(FeatureIds ids, double limit) const {
        const std::array<Vec3, 4> at = pairs_.points(ids);
        return are_within(kind, at, feature_distance(kind, at), limit);
    }

    PairsOfKind<kind> pairs_;
    std::vector<std::uint64_t>& keys_;
    NearBatch batch_;
    std::array<FeatureIds, NearBatch::kLanes> items_{};
    std::size_t count_ = 0;
};

/// A sink of pairs (see FeaturePairs) that keeps the list keys of those that are near.
class NearPairs {
public:
    NearPairs(const NearQuery& query, std::vector<std::uint64_t>& keys)
        : edges_(query, false, keys), vertex_face_(query, false, keys),
          face_vertex_(query, true, keys) {}

    void add(PairKind kind, FeatureIds ids, bool wanted) {
        if (kind == PairKind::edges)
            edges_.add(ids, wanted);
        else
            (kind == PairKind::vertex_face ? vertex_face_ : face_vertex_).add(ids, wanted);
    }
    static bool is_done() { return false; }
    void finish() {
        edges_.finish();
        vertex_face_.finish();
        face_vertex_.finish();
    }

private:
    NearTests<ElementaryKind::edge_edge> edges_;
    NearTests<ElementaryKind::vertex_face> vertex_face_, face_vertex_;
};

/// Measures the pairs of these keys, in parallel.
std::vector<FeaturePair> measured(const NearQuery& query, std::span<const std::uint64_t> keys) {
    constexpr std::size_t kPairsAtOnce = 1024;
    const PairsOfKind<ElementaryKind::edge_edge> edges(query, false);
    const PairsOfKind<ElementaryKind::vertex_face> vertex_face(query, false);
    const PairsOfKind<ElementaryKind::vertex_face> face_vertex(query, true);
    std::vector<FeaturePair> pairs(keys.size());
    parallel_for(keys.size(), kPairsAtOnce, [&](std::size_t i) {
        const KeyedPair pair(keys[i]);
        pairs[i] = pair.kind == ElementaryKind::edge_edge ? edges.measured(pair.ids)
                   : pair.face_first                      ? face_vertex.measured(pair.ids)
                                                          : vertex_face.measured(pair.ids);
    });
    return pairs;
}

std::vector<FeaturePair> find_near(const DeformableData& a, const DeformableData& b,
                                   double distance, const NearOptions& options) {
    const bool is_self = &a == &b;
    require_valid_near(distance, is_self, options.vertices_b);
    const NearQuery query{a,
                          b,
                          distance,
                          options.vertices,
                          is_self ? options.vertices : options.vertices_b,
                          options.at_end ? StepEnd::end : StepEnd::start};
    require_valid_vertices(query.of_a, a);
    require_valid_vertices(query.of_b, b);

    const StopScope stopping(options.progress);
    const RestSearch search(a, b, query.at, distance, query.of_a, query.of_b);
    std::vector<std::vector<std::uint64_t>> parts(search.tasks());
    parallel_for(search.tasks(), 1, [&](std::size_t i) {
        NearPairs sink(query, parts[i]);
        search.run(i, sink);
        sink.finish();
    });
    std::vector<std::uint64_t> keys;
    for (std::vector<std::uint64_t>& part : parts) {
        keys.insert(keys.end(), part.begin(), part.end());
        part = std::vector<std::uint64_t>(); // `{}` would keep its memory
    }
    parallel_sort(keys.begin(), keys.end());
    return measured(query, keys);
}

} // namespace

std::vector<FeaturePair> self_within(const Deformable& surface, double distance,
                                     const NearOptions& options) {
    return find_near(surface.data(), surface.data(), distance, options);
}
std::vector<FeaturePair> within(const Deformable& a, const Deformable& b, double distance,
                                const NearOptions& options) {
    return find_near(a.data(), b.data(), distance, options);
}

} // namespace abut
