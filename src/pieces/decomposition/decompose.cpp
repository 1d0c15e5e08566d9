#include "pieces/decomposition/decompose.h"

#include "pieces/decomposition/convex_component.h"
#include "pieces/decomposition/exact_plane.h"
#include "pieces/decomposition/patch_hull.h"
#include "rigid/model/placed_model.h"

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
/// Limit on a patch's triangles: some steps of its growth pass over the whole hull.
constexpr std::size_t kLargestPatch = 1 << 14;

class Decomposition {
public:
    Decomposition(const Model& solid, const SurfaceGraph& surface)
        : placed_(solid, {}), surface_(surface), planes_(planes_of(surface)),
          hull_(surface.positions, planes_), piece_of_(surface.corners.size(), kNone),
          tried_(surface.corners.size(), kNone), in_patch_(surface.positions.size(), kNone) {}

    Pieces run() && {
        for (std::vector<std::uint32_t>& component : convex_components(placed_, surface_)) {
            for (const std::uint32_t t : component)
                piece_of_[t] = next_piece();
            pieces_.push_back(std::move(component));
        }
        for (std::uint32_t t = 0; t < piece_of_.size(); ++t)
            if (piece_of_[t] == kNone)
                grow(t);
        return std::move(pieces_);
    }

private:
    [[nodiscard]] std::uint32_t next_piece() const {
        return static_cast<std::uint32_t>(pieces_.size());
    }

    static std::vector<ExactPlane> planes_of(const SurfaceGraph& surface) {
        std::vector<ExactPlane> planes;
        planes.reserve(surface.corners.size());
        for (std::uint32_t t = 0; t < surface.corners.size(); ++t)
            planes.emplace_back(surface.triangle(t));
        return planes;
    }

    /// Grows a patch breadth first. A triangle that is refused once would be refused later too,
    /// since the patch only gains planes and vertices.
    void grow(std::uint32_t seed) {
        patch_.clear();
        add(seed);
        tried_[seed] = next_piece();
        const bool grows = !surface_.is_degenerate(seed);
        if (grows)
            hull_.begin(surface_.corners[seed], seed);
        for (std::size_t i = 0; i < patch_.size() && grows; ++i)
            for (const std::uint32_t t : surface_.across[patch_[i]]) {
                if (t == kNoEdge || piece_of_[t] != kNone || tried_[t] == next_piece())
                    continue;
                tried_[t] = next_piece();
                if (patch_.size() < kLargestPatch && joins(t))
                    add(t);
            }
        pieces_.push_back(patch_);
    }

    void add(std::uint32_t t) {
        patch_.push_back(t);
        piece_of_[t] = next_piece();
        for (const std::uint32_t v : surface_.corners[t])
            in_patch_[v] = next_piece();
    }

    /// Enlarges the hull by a triangle, if the patch stays on the hull and no other triangle enters
    /// it. Returns whether it did.
    bool joins(std::uint32_t t) {
        const IndexTriangle& corners = surface_.corners[t];
        const bool has_area = !surface_.is_degenerate(t);
        if (!hull_.lies_behind(corners, t, has_area))
            return false;
        // The other two corners are those of the common edge.
        const auto added = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t v) {
            return in_patch_[v] != next_piece();
        });
        if (added != corners.end()) {
            if (!hull_.propose(*added, corners, has_area))
                return false;
            if (hull_.grows() && !is_free(t)) {
                hull_.take_back();
                return false;
            }
        }
        hull_.cover(corners, t, has_area);
        return true;
    }

    [[nodiscard]] bool is_free(std::uint32_t added) {
        bool free = true;
        Vec3 last;
        placed_.for_each_overlap_outside(hull_.gained(), [&](std::uint32_t slot) {
            const std::uint32_t t = placed_.data().triangle_at(slot);
            if (!free || t == added || piece_of_[t] == next_piece())
                return PlacedModel::HalfSpace{};
            const auto outside = hull_.outside(surface_.corners[t], t);
            free = outside.has_value();
            if (!free || outside->normal == last)
                return PlacedModel::HalfSpace{};
            last = outside->normal;
            return *outside;
        });
        return free;
    }

    PlacedModel placed_;
    const SurfaceGraph& surface_;
    std::vector<ExactPlane> planes_; ///< of the triangles
    PatchHull hull_;
    Pieces pieces_;
    /// By triangle: its piece; the last piece that tried it.
    std::vector<std::uint32_t> piece_of_, tried_;
    std::vector<std::uint32_t> in_patch_; ///< by vertex: the last piece with that vertex
    std::vector<std::uint32_t> patch_;
};

} // namespace

Pieces decompose(const Model& solid, const SurfaceGraph& surface) {
    return Decomposition(solid, surface).run();
}

} // namespace abut
