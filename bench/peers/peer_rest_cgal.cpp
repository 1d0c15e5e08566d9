#include "peers/peer_rest.h"

#ifdef ABUT_BENCH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <iterator>
#include <utility>
#include <vector>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_CGAL

namespace pmp = CGAL::Polygon_mesh_processing;

struct CgalSelfIntersections::Data {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    CGAL::Surface_mesh<Kernel::Point_3> mesh;
};

CgalSelfIntersections::CgalSelfIntersections(const Mesh& mesh) {
    std::vector<Data::Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Vec3& p : mesh.positions)
        points.emplace_back(p.x, p.y, p.z);
    for (const auto& t : mesh.triangles)
        faces.push_back({t[0], t[1], t[2]});
    if (!pmp::is_polygon_soup_a_polygon_mesh(faces))
        return;
    data_ = std::make_unique<Data>();
    pmp::polygon_soup_to_polygon_mesh(points, faces, data_->mesh);
}

std::optional<std::size_t> CgalSelfIntersections::count() const {
    if (!data_)
        return {};
    using Face = boost::graph_traits<decltype(data_->mesh)>::face_descriptor;
    std::vector<std::pair<Face, Face>> pairs;
    pmp::self_intersections(data_->mesh, std::back_inserter(pairs));
    return pairs.size();
}

#else

struct CgalSelfIntersections::Data {};
CgalSelfIntersections::CgalSelfIntersections(const Mesh& /*mesh*/) {}
std::optional<std::size_t> CgalSelfIntersections::count() const {
    return {};
}

#endif

CgalSelfIntersections::~CgalSelfIntersections() = default;

} // namespace abut::bench
