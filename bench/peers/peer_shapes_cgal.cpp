#include "peers/peer_shapes.h"

#ifdef ABUT_BENCH_CGAL
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <cmath>
#include <vector>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_CGAL

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;

class CgalNearest : public NearestPeer {
public:
    explicit CgalNearest(const Mesh& mesh) {
        const auto point = [&](std::uint32_t v) {
            const Vec3& p = mesh.positions[v];
            return Kernel::Point_3(p.x, p.y, p.z);
        };
        for (const auto& t : mesh.triangles)
            triangles_.emplace_back(point(t[0]), point(t[1]), point(t[2]));
        tree_.insert(triangles_.begin(), triangles_.end());
        tree_.build();
        tree_.accelerate_distance_queries();
    }

    [[nodiscard]] double distance(const Vec3& p) const override {
        return std::sqrt(tree_.squared_distance({p.x, p.y, p.z}));
    }

private:
    Triangles triangles_;
    CGAL::AABB_tree<
        CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>>
        tree_;
};

} // namespace

std::unique_ptr<NearestPeer> make_cgal_nearest(const Mesh& mesh) {
    return std::make_unique<CgalNearest>(mesh);
}

#else

std::unique_ptr<NearestPeer> make_cgal_nearest(const Mesh& /*mesh*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
