#include "peers/peer_rigid.h"

#ifdef ABUT_BENCH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_CGAL

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh convert(const Mesh& mesh) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Vec3& p : mesh.positions)
        points.emplace_back(p.x, p.y, p.z);
    for (const auto& t : mesh.triangles)
        faces.push_back({t[0], t[1], t[2]});
    SurfaceMesh result;
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, faces);
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, result);
    return result;
}

Kernel::Aff_transformation_3 placement(const Transform& t) {
    const auto& m = t.m;
    return {m[0], m[3], m[6], m[9], m[1], m[4], m[7], m[10], m[2], m[5], m[8], m[11], 1.0};
}

class CgalPeer final : public RigidPeer {
public:
    CgalPeer(const Mesh& a, const Mesh& b)
        : mesh_a_(convert(a)), mesh_b_(convert(b)), a_(detection_.add_mesh(mesh_a_)),
          b_(detection_.add_mesh(mesh_b_)) {}

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] bool answers(RigidQuery query) const override {
        return query == RigidQuery::first_contact;
    }
    void place(const PosedPair& poses) override {
        detection_.set_transformation(a_, placement(poses.a));
        detection_.set_transformation(b_, placement(poses.b));
    }
    double run(RigidQuery /*query*/, const PosedPair& /*poses*/, double /*tolerance*/) override {
        return detection_.get_all_intersections(a_).empty() ? 0 : 1;
    }

private:
    std::string name_ = "CGAL " CGAL_VERSION_STR;
    SurfaceMesh mesh_a_, mesh_b_; ///< the detection refers to them
    CGAL::Rigid_triangle_mesh_collision_detection<SurfaceMesh> detection_;
    std::size_t a_, b_;
};

} // namespace

std::unique_ptr<RigidPeer> make_cgal_peer(const Mesh& a, const Mesh& b) {
    return std::make_unique<CgalPeer>(a, b);
}

#else

std::unique_ptr<RigidPeer> make_cgal_peer(const Mesh& /*a*/, const Mesh& /*b*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
