#include "geometry/triangle_triangle_segment.h"
#include "math/predicates.h"
#include "rigid/contacts.h"

#include <algorithm>
#include <bit>

namespace abut {

namespace {

class ContactFinder : public LeafPairVisitor {
public:
    ContactFinder(const PlacedPair& pair, ContactMode mode, Counters& counters)
        : mode_(mode), counters_(counters), leaves_(pair) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b) override {
        leaves_.fetch(leaf_a, leaf_b);
        for (std::uint32_t i = 0; i < leaves_.count_a(); ++i) {
            counters_.primitive_tests += leaf_b.count();
            std::uint32_t lanes = may_intersect(leaves_.a(i), leaves_.b()) & leaves_.lanes_b();
            for (; lanes != 0; lanes &= lanes - 1) {
                const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
                const auto kind = triangle_triangle_intersect(leaves_.a(i), leaves_.b().get(lane));
                if (kind == TriangleContact::none)
                    continue;
                contacts.push_back({leaves_.indices(i, lane), kind});
                if (mode_ == ContactMode::first)
                    return -1;
            }
        }
        return 0;
    }

    std::vector<Contact> contacts;

private:
    ContactMode mode_;
    Counters& counters_;
    LeafTriangles leaves_;
};

} // namespace

std::vector<Contact> find_contacts(const PlacedPair& pair, ContactMode mode, Counters& counters) {
    const std::uint64_t exact_before = exact_signs();
    ContactFinder finder(pair, mode, counters);
    PairTraversal traversal = pair.traversal(0);
    traverse_depth_first(traversal, finder);
    counters.volume_tests += traversal.volume_tests;
    counters.exact_tests += exact_signs() - exact_before;
    return std::move(finder.contacts);
}

Intersection common_points(const PlacedPair& pair, const TrianglePair& triangles) {
    const auto corners = [](const ModelData& model, const Transform& world, std::uint32_t i) {
        const auto& t = model.mesh().triangles[i];
        const auto& p = model.mesh().positions;
        return Triangle{apply(world, p[t[0]]), apply(world, p[t[1]]), apply(world, p[t[2]])};
    };
    return triangle_triangle_segment(corners(pair.a(), pair.world_from_a(), triangles.a),
                                     corners(pair.b(), pair.world_from_b(), triangles.b));
}

Contacts collide(const Model& a, const Transform& world_from_a, const Model& b,
                 const Transform& world_from_b, const CollideOptions& options) {
    Contacts result;
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    for (const Contact& c : find_contacts(pair, options.mode, result.counters))
        result.pairs.push_back(c.pair);
    std::sort(result.pairs.begin(), result.pairs.end());
    if (options.segments)
        for (const TrianglePair& triangles : result.pairs)
            result.segments.push_back(common_points(pair, triangles));
    return result;
}

} // namespace abut
