#include "clash/building/light_mesh.h"

#include "math/rounding.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <meshoptimizer.h>

namespace abut {

namespace {

/// Fewer triangles than a box has are not worth a simplification.
constexpr std::size_t kFewTriangles = 12;
/// Meshes with more triangles for each one that is asked for are first thinned on a grid, which is
/// ten times as fast as collapsing edges one by one.
constexpr std::size_t kMuchTooMany = 24;

/// A mesh in single precision about its lower corner.
struct FloatMesh {
    std::vector<float> positions;
    std::vector<unsigned int> indices;
    float extent = 0;
    Vec3 lower;

    explicit FloatMesh(const Mesh& mesh) {
        Box3 box;
        for (const Vec3& p : mesh.positions)
            extend(box, p);
        lower = box.lower;
        extent = to_float(max_abs(box.upper - box.lower));
        positions.reserve(3 * mesh.positions.size());
        for (const Vec3& p : mesh.positions)
            for (const double value : {p.x - lower.x, p.y - lower.y, p.z - lower.z})
                positions.push_back(to_float(value));
        indices.reserve(3 * mesh.triangles.size());
        for (const auto& triangle : mesh.triangles)
            indices.insert(indices.end(), triangle.begin(), triangle.end());
    }

    /// Simplifies to at most about `target` triangles within the error if possible.
    void simplify(std::size_t target, double error) {
        if (indices.size() / 3 <= kFewTriangles || extent <= 0)
            return;
        const float relative = to_float(std::min(1.0, error / extent));
        const std::size_t vertices = positions.size() / 3;
        std::vector<unsigned int> fewer(indices.size());
        if (indices.size() / 3 > kMuchTooMany * target)
            thin(fewer, 4 * target);
        fewer.resize(indices.size());
        fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(),
                                      positions.data(), vertices, 3 * sizeof(float), 0, relative, 0,
                                      nullptr));
        if (fewer.size() >= 3)
            indices.swap(fewer);
        if (indices.size() / 3 > target)
            thin(fewer, target);
    }

private:
    void thin(std::vector<unsigned int>& fewer, std::size_t target) {
        fewer.resize(indices.size());
        fewer.resize(meshopt_simplifySloppy(
            fewer.data(), indices.data(), indices.size(), positions.data(), positions.size() / 3,
            3 * sizeof(float), 3 * std::max(target, kFewTriangles), 1.0F, nullptr));
        if (fewer.size() >= 3)
            indices.swap(fewer);
    }
};

} // namespace

LightMeshBuilder::LightMeshBuilder(const Vec3& lower, const LightMeshTerms& terms) : terms_(terms) {
    result_.lower = lower;
    result_.step = terms.step;
}

void LightMeshBuilder::add(const Mesh& piece) {
    FloatMesh mesh(piece);
    const auto target = static_cast<std::size_t>(
        std::ceil(terms_.share * static_cast<double>(piece.triangles.size())));
    if (terms_.error > 0 || target < piece.triangles.size())
        mesh.simplify(std::max<std::size_t>(target, 1), terms_.error);
    if (mesh.indices.empty())
        return;
    const std::size_t vertices = piece.positions.size();
    meshopt_optimizeVertexCache(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                vertices);
    // Vertices become points of the grid; a triangle between equal points is left out.
    const Vec3 shift = mesh.lower - result_.lower;
    const auto on_grid = [&](double value) {
        return static_cast<std::uint32_t>(std::max(0.0, std::round(value / result_.step)));
    };
    std::vector<std::uint32_t> number_of(vertices, 0xffffffff);
    const auto grid_point = [&](unsigned int v) {
        const float* const p = &mesh.positions[3 * std::size_t{v}];
        return std::array{on_grid(shift.x + p[0]), on_grid(shift.y + p[1]),
                          on_grid(shift.z + p[2])};
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const unsigned int* const corner = &mesh.indices[i];
        const std::array points{grid_point(corner[0]), grid_point(corner[1]),
                                grid_point(corner[2])};
        if (points[0] == points[1] || points[1] == points[2] || points[2] == points[0])
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& number = number_of[corner[k]];
            if (number == 0xffffffff) {
                number = static_cast<std::uint32_t>(result_.vertices.size());
                result_.vertices.push_back(points.at(k));
            }
            result_.indices.push_back(number);
        }
    }
}

} // namespace abut
