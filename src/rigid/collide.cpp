#include "geometry/triangle_triangle_segment.h"
#include "math/predicates.h"
#include "rigid/pair/contacts.h"
#include "rigid/pair/separating_plane.h"

#include <algorithm>

namespace abut {

namespace {

class ContactFinder : public LeafPairVisitor {
public:
    ContactFinder(const PlacedPair& pair, ContactMode mode) : mode_(mode), leaves_(pair) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        leaves_.set_leaves(leaf_a, leaf_b);
        const auto add = [&](auto i, auto j, TriangleContact kind) {
            if (kind != TriangleContact::none)
                contacts.push_back({leaves_.indices(i, j), kind});
            return kind == TriangleContact::none || mode_ == ContactMode::all;
        };
        const bool go_on =
            for_each_pair(pairs.cross,
                          [&](auto i, auto j) { return add(i, j, TriangleContact::cross); }) &&
            for_each_pair(pairs.may_meet, [&](auto i, auto j) {
                return add(i, j, triangle_triangle_intersect(leaves_.a(i), leaves_.b(j)));
            });
        return go_on ? 0 : kStopTraversal;
    }

    std::vector<Contact> contacts;

private:
    ContactMode mode_;
    LeafTriangles leaves_;
};

/// The order of TrianglePair, by one comparison: sorting is a twentieth of a query with many
/// contacts.
bool pair_before(const TrianglePair& x, const TrianglePair& y) {
    const auto key = [](const TrianglePair& pair) { return std::uint64_t{pair.a} << 32 | pair.b; };
    return key(x) < key(y);
}

bool still_meet(const PlacedPair& pair, const TrianglePair& last) {
    return pair.has(last) &&
           triangle_triangle_intersect(pair.triangle_a(last.a), pair.triangle_b(last.b)) !=
               TriangleContact::none;
}

} // namespace

std::vector<Contact> find_contacts(const PlacedPair& pair, ContactMode mode, Counters& counters,
                                   SearchSteps* steps) {
    const std::uint64_t exact_before = exact_signs();
    ContactFinder finder(pair, mode);
    PairTraversal traversal = pair.traversal(0);
    if (steps != nullptr)
        traversal.steps = *steps;
    pair.visit_contacts(traversal, finder);
    if (steps != nullptr)
        *steps = traversal.steps;
    counters.volume = pair.volume();
    counters.volume_tests += traversal.volume_tests;
    counters.primitive_tests += traversal.primitive_tests;
    counters.exact_tests += exact_signs() - exact_before;
    return std::move(finder.contacts);
}

Intersection common_points(const PlacedPair& pair, const TrianglePair& triangles) {
    return triangle_triangle_segment(pair.triangle_a(triangles.a), pair.triangle_b(triangles.b));
}

Contacts collide(const Model& a, const Transform& world_from_a, const Model& b,
                 const Transform& world_from_b, const CollideOptions& options) {
    const StopScope stopping(options.progress);
    Contacts result;
    if (far_apart(a.data(), world_from_a, b.data(), world_from_b, 0))
        return result;
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    WarmStart* const warm_start = options.mode == ContactMode::first ? options.warm_start : nullptr;
    if (warm_start != nullptr && warm_start->used && still_meet(pair, warm_start->last)) {
        result.pairs.push_back(warm_start->last);
    } else {
        const std::vector<Contact> contacts = find_contacts(pair, options.mode, result.counters);
        result.pairs.reserve(contacts.size());
        for (const Contact& c : contacts)
            result.pairs.push_back(c.pair);
        std::sort(result.pairs.begin(), result.pairs.end(), pair_before);
        if (warm_start != nullptr && result.meet())
            *warm_start = {true, result.pairs[0]};
    }
    SearchSteps steps;
    if (options.segments)
        for (const TrianglePair& triangles : result.pairs) {
            steps.take();
            result.segments.push_back(common_points(pair, triangles));
        }
    return result;
}

} // namespace abut
