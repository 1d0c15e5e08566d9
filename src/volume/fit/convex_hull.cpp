#include "volume/fit/convex_hull.h"

#include <algorithm>
#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace abut {

namespace {

/// One run of Qhull's reentrant interface.
class QhullRun {
public:
    QhullRun() { qh_zero(&state_, nowhere()); }
    QhullRun(const QhullRun&) = delete;
    QhullRun& operator=(const QhullRun&) = delete;
    ~QhullRun() {
        qh_freeqhull(&state_, qh_ALL);
        int blocks = 0, bytes = 0;
        qh_memfreeshort(&state_, &blocks, &bytes);
    }

    /// Returns false if the points span no volume beyond rounding.
    bool run(std::vector<double>& coordinates) {
        // Qt: triangulates facets. Pp: suppresses reports of lost precision.
        char options[] = "qhull Qt Pp";
        return qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3),
                            coordinates.data(), False, options, nowhere(), nowhere()) == 0;
    }

    /// Calls visit(x, y, z) with the coordinates of each facet's vertices.
    template <typename Visit>
    void for_each_facet(const Visit& visit) const {
        // The list ends with a sentinel.
        for (const facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr;
             facet = facet->next) {
            const auto* vertex = reinterpret_cast<vertexT* const*>(&facet->vertices->e[0].p);
            if (vertex[0] != nullptr && vertex[1] != nullptr && vertex[2] != nullptr)
                visit(vertex[0]->point, vertex[1]->point, vertex[2]->point);
        }
    }

private:
    /// Discards Qhull's messages; its exit code is sufficient.
    static std::FILE* nowhere() {
        static const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
            std::fopen("/dev/null", "w"), &std::fclose);
        return file.get();
    }

    qhT state_{};
};

} // namespace

std::vector<Triangle> convex_hull(std::span<const Vec3> points) {
    Box3 box;
    for (const Vec3& p : points)
        extend(box, p);
    const Vec3 size = box.upper - box.lower;
    const double largest = std::max({size.x, size.y, size.z});
    if (points.size() < 4 || !(largest > 0))
        return {};
    // Qhull's tolerances depend on the largest coordinate, so it gets the points scaled to a unit
    // cube.
    std::vector<double> coordinates;
    coordinates.reserve(3 * points.size());
    for (const Vec3& p : points) {
        const Vec3 unit = (1 / largest) * (p - box.lower);
        coordinates.insert(coordinates.end(), {unit.x, unit.y, unit.z});
    }
    QhullRun qhull;
    if (!qhull.run(coordinates))
        return {};
    std::vector<Triangle> hull;
    qhull.for_each_facet([&](const double* x, const double* y, const double* z) {
        Triangle t;
        for (std::size_t i = 0; const double* v : {x, y, z})
            t[i++] = box.lower + largest * Vec3{v[0], v[1], v[2]};
        hull.push_back(t);
    });
    return hull;
}

} // namespace abut
