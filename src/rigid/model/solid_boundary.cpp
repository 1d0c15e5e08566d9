#include "rigid/model/solid_boundary.h"

#include "core/parallel.h"
#include "geometry/convex_polygon.h"
#include "rigid/model/face_fragments.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// The triangles of a mesh without dropped copies.
struct DistinctTriangles {
    Mesh mesh;
    std::vector<std::uint32_t> source; ///< by triangle: its number in the whole mesh
    std::vector<FaceFragments::Face> faces;

    DistinctTriangles(const Mesh& whole, const Solid& solid) {
        mesh.positions = whole.positions;
        std::size_t copy = 0;
        for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
            if (copy < solid.copies.size() && solid.copies[copy] == t) {
                ++copy;
                continue;
            }
            mesh.triangles.push_back(whole.triangles[t]);
            source.push_back(t);
            faces.push_back({0, static_cast<std::int8_t>(solid.weight(t))});
        }
    }
};

/// Collects the fragments that do not lie inside the solid.
class BoundaryMesh {
public:
    BoundaryMesh(const Mesh& mesh, const Solid& solid, const std::vector<std::uint32_t>& source)
        : mesh_(mesh), solid_(solid), numbers_(source) {
        result_.positions = mesh.positions;
    }

    void add(const FaceFragments::Fragment& fragment) {
        const auto &over = fragment.sides.over, &under = fragment.sides.under;
        if (std::min(over[0], under[0]) < 0)
            backwards_ += area_of(fragment.corners);
        if (over[0] >= 1 && under[0] >= 1) {
            any_hidden_ = true;
            return;
        }
        const int bounds = (under[0] >= 1 ? 1 : 0) - (over[0] >= 1 ? 1 : 0);
        const int weight = fragment.sides.is_first ? bounds : 0;
        for (std::size_t i = 2; i < fragment.corners.size() && weight != 0; ++i)
            areas_ = areas_ + (0.5 * weight) * cross(fragment.corners[i - 1] - fragment.corners[0],
                                                     fragment.corners[i] - fragment.corners[0]);
        const std::uint32_t triangle = numbers_[fragment.triangle];
        if (fragment.is_whole) {
            add(mesh_.triangles[triangle], triangle, weight);
            return;
        }
        const auto first = static_cast<std::uint32_t>(result_.positions.size());
        result_.positions.insert(result_.positions.end(), fragment.corners.begin(),
                                 fragment.corners.end());
        for (std::uint32_t i = 2; i < fragment.corners.size(); ++i)
            add({first, first + i - 1, first + i}, triangle, weight);
    }

    /// Returns whether the solid winds backwards beside faces that are no slits at T-junctions, or has a border
    /// that is wider than these. Cavities that overlap make a closed one wind backwards.
    [[nodiscard]] bool contradicts(const FacesUncertainty& uncertainty) const {
        if (solid_.closed)
            return false;
        Box3 box;
        double edges = 0;
        for (const auto& t : mesh_.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &p = mesh_.positions[t.at(k)], &q = mesh_.positions[t.at((k + 1) % 3)];
                extend(box, p);
                edges += length(q - p);
            }
        const double slits = kWindingRounding * length(box.upper - box.lower) * edges;
        return backwards_ > slits || length(areas_) > slits + uncertainty.area;
    }

    /// Null if nothing lies inside and each triangle counts as its solid says.
    std::shared_ptr<const SolidBoundary> take(const FacesUncertainty& uncertainty) {
        if (!any_hidden_ && !differs_)
            return nullptr;
        return std::make_shared<const SolidBoundary>(SolidBoundary{
            Model(std::move(result_)), std::move(source_), std::move(weight_), uncertainty});
    }

private:
    void add(const std::array<std::uint32_t, 3>& corners, std::uint32_t triangle, int weight) {
        result_.triangles.push_back(corners);
        source_.push_back(triangle);
        weight_.push_back(static_cast<std::int8_t>(weight));
        differs_ |= weight != solid_.weight(triangle);
    }

    const Mesh& mesh_;
    const Solid& solid_;
    const std::vector<std::uint32_t>& numbers_; ///< of the fragments' triangles in the mesh
    Mesh result_;
    std::vector<std::uint32_t> source_;
    std::vector<std::int8_t> weight_;
    bool any_hidden_ = false, differs_ = false;
    double backwards_ = 0; ///< area of faces beside which the solid winds backwards
    Vec3 areas_;           ///< the sum of areas along normals outwards: 0 without a border
};

} // namespace

BoundarySearch find_boundary(const Mesh& mesh, const Solid& solid) {
    BoundarySearch result;
    // A thread that searches must not run other tasks meanwhile: they might ask for the same
    // boundary.
    isolated([&] {
        DistinctTriangles distinct(mesh, solid);
        BoundaryMesh boundary(mesh, solid, distinct.source);
        FaceFragments fragments(std::move(distinct.mesh), std::move(distinct.faces));
        result.is_known =
            fragments.for_each([&](const FaceFragments::Fragment& f) { boundary.add(f); });
        result.is_known = result.is_known && !boundary.contradicts(fragments.uncertainty());
        if (result.is_known)
            result.boundary = boundary.take(fragments.uncertainty());
    });
    return result;
}

} // namespace abut
