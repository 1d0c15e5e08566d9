#include "rigid/model/solid_boundary.h"

#include "core/parallel.h"
#include "rigid/model/face_fragments.h"
#include "rigid/model/shell_sets.h"

#include <utility>

namespace abut {

namespace {

FaceFragments fragments_of(const Mesh& mesh, const Solid& solid) {
    std::vector<bool> dropped(solid.weights.size());
    for (std::size_t t = 0; t < dropped.size(); ++t)
        dropped[t] = solid.weights[t] == 0;
    const ShellSets shells = find_shells(mesh, solid.topology, dropped);
    std::vector<FaceFragments::Face> faces(mesh.triangles.size());
    for (std::uint32_t t = 0; t < faces.size(); ++t)
        faces[t] = {shells.shell_of[t], 0, static_cast<std::int8_t>(solid.weight(t))};
    return {mesh, std::move(faces)};
}

/// Collects the fragments that do not lie inside the solid.
class BoundaryMesh {
public:
    BoundaryMesh(const Mesh& mesh, const Solid& solid) : mesh_(mesh), solid_(solid) {
        result_.positions = mesh.positions;
    }

    void add(const FaceFragments::Fragment& fragment) {
        const auto &over = fragment.sides.over, &under = fragment.sides.under;
        if (over[0] >= 1 && under[0] >= 1) {
            any_hidden_ = true;
            return;
        }
        const int bounds = (under[0] >= 1 ? 1 : 0) - (over[0] >= 1 ? 1 : 0);
        const int weight = fragment.sides.is_first ? bounds : 0;
        if (fragment.is_whole) {
            add(mesh_.triangles[fragment.triangle], fragment.triangle, weight);
            return;
        }
        const auto first = static_cast<std::uint32_t>(result_.positions.size());
        result_.positions.insert(result_.positions.end(), fragment.corners.begin(),
                                 fragment.corners.end());
        for (std::uint32_t i = 2; i < fragment.corners.size(); ++i)
            add({first, first + i - 1, first + i}, fragment.triangle, weight);
    }

    /// Null if nothing lies inside and each triangle counts as its solid says.
    std::shared_ptr<const SolidBoundary> take() {
        if (!any_hidden_ && !differs_)
            return nullptr;
        return std::make_shared<const SolidBoundary>(
            SolidBoundary{Model(std::move(result_)), std::move(source_), std::move(weight_)});
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
    Mesh result_;
    std::vector<std::uint32_t> source_;
    std::vector<std::int8_t> weight_;
    bool any_hidden_ = false, differs_ = false;
};

} // namespace

BoundarySearch find_boundary(const Mesh& mesh, const Solid& solid) {
    BoundarySearch result;
    // A thread that searches must not run other tasks meanwhile: they might ask for the same
    // boundary.
    isolated([&] {
        FaceFragments fragments = fragments_of(mesh, solid);
        BoundaryMesh boundary(mesh, solid);
        result.is_known =
            fragments.for_each([&](const FaceFragments::Fragment& f) { boundary.add(f); });
        if (result.is_known)
            result.boundary = boundary.take();
    });
    return result;
}

} // namespace abut
