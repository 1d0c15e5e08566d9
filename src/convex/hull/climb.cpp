#include "convex/hull/climb.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convex/hull/climb.cpp"
#include "simd/foreach_target.h"
#include "convex/hull/climb-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

std::uint32_t climb_one(const Polytope& polytope, const Vec3& direction, std::uint32_t start) {
    rings::Climber climber(polytope, direction, start);
    while (climber.step()) {
    }
    return climber.vertex();
}

VertexPair farthest_of_two(const Polytope& a, const Vec3& direction_a, const Polytope& b,
                           const Vec3& direction_b) {
    return rings::farthest_two(a, direction_a, b, direction_b);
}

void climb_two(const Polytope& a, const Vec3& direction_a, const Polytope& b,
               const Vec3& direction_b, FarthestPair& found) {
    const auto find = [](const Polytope& p, const Vec3& direction, double& lead) HWY_ATTR {
        lead = std::numeric_limits<double>::infinity();
        if (!p.columns.empty())
            return rings::scan(p, direction);
        rings::Climber climber(p, direction, p.starts.vertex(direction));
        while (climber.step()) {
        }
        lead = climber.lead();
        return climber.vertex();
    };
    found.vertices.a = find(a, direction_a, found.lead_a);
    found.vertices.b = find(b, direction_b, found.lead_b);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(climb_one);
HWY_EXPORT(farthest_of_two);
HWY_EXPORT(climb_two);

std::uint32_t climb(const Polytope& polytope, const Vec3& direction, std::uint32_t start) {
    return HWY_DYNAMIC_DISPATCH(climb_one)(polytope, direction, start);
}

VertexPair farthest(const PolytopePair& pair, const Vec3& direction) {
    return HWY_DYNAMIC_DISPATCH(farthest_of_two)(*pair.a.polytope, pair.a.pulled_back(direction),
                                                 *pair.b.polytope, pair.b.pulled_back(-direction));
}

FarthestPair farthest_with_lead(const Polytope& a, const Vec3& direction_a, const Polytope& b,
                                const Vec3& direction_b) {
    FarthestPair found;
    HWY_DYNAMIC_DISPATCH(climb_two)(a, direction_a, b, direction_b, found);
    return found;
}

} // namespace abut
#endif
