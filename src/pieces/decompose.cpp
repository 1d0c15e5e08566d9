#include "pieces/decompose.h"

#include "pieces/convex_component.h"
#include "pieces/exact_plane.h"
#include "pieces/patch_hull.h"
#include "rigid/placed_model.h"

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
/// Triangles of a patch, at most: its growth is quadratic.
constexpr std::size_t kLargestPatch = 2048;

class Decomposition {
public:
    Decomposition(const Model& solid, const SurfaceGraph& surface)
        : placed_(solid, {}), surface_(surface), hull_(surface.positions),
          piece_of_(surface.corners.size(), kNone), tried_(surface.corners.size(), kNone),
          in_patch_(surface.positions.size(), kNone) {
        planes_.reserve(surface.corners.size());
        for (std::uint32_t t = 0; t < surface.corners.size(); ++t)
            planes_.emplace_back(surface.triangle(t));
    }

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

    /// Breadth first. What a patch refuses it refuses for good: it has only more planes and
    /// vertices later.
    void grow(std::uint32_t seed) {
        patch_.clear();
        vertices_.clear();
        hull_.begin(surface_.corners[seed]);
        add(seed);
        tried_[seed] = next_piece();
        for (std::size_t i = 0; i < patch_.size() && !surface_.is_degenerate(seed); ++i)
            for (const std::uint32_t t : surface_.across[patch_[i]]) {
                if (t == kNoEdge || piece_of_[t] != kNone || tried_[t] == next_piece())
                    continue;
                tried_[t] = next_piece();
                if (patch_.size() < kLargestPatch && stays_convex(t) && stays_inside(t))
                    add(t);
            }
        pieces_.push_back(patch_);
    }

    void add(std::uint32_t t) {
        patch_.push_back(t);
        piece_of_[t] = next_piece();
        for (const std::uint32_t v : surface_.corners[t])
            if (!has(v)) {
                in_patch_[v] = next_piece();
                vertices_.push_back(v);
            }
    }

    [[nodiscard]] bool has(std::uint32_t vertex) const { return in_patch_[vertex] == next_piece(); }
    [[nodiscard]] int side(std::uint32_t triangle, std::uint32_t vertex) const {
        return planes_[triangle].side(surface_.positions[vertex]);
    }

    /// No vertex lies in front of any triangle's plane.
    [[nodiscard]] bool stays_convex(std::uint32_t t) const {
        bool in_plane = true;
        for (const std::uint32_t v : vertices_) {
            const int s = side(t, v);
            if (s > 0)
                return false;
            in_plane = in_plane && s == 0;
        }
        // A flat patch has one front.
        if (in_plane && hull_.is_flat() && !surface_.is_degenerate(t) &&
            !hull_.faces_alike(surface_.triangle(t)))
            return false;
        for (const std::uint32_t v : surface_.corners[t])
            if (!has(v) && std::any_of(patch_.begin(), patch_.end(),
                                       [&](std::uint32_t p) { return side(p, v) > 0; }))
                return false;
        return true;
    }

    /// Enlarges the hull if no other triangle enters it.
    bool stays_inside(std::uint32_t t) {
        for (const std::uint32_t v : surface_.corners[t]) {
            if (has(v))
                continue;
            hull_.propose(v);
            if (hull_.grows() && !is_free(t))
                return false;
            hull_.take();
        }
        return true;
    }

    [[nodiscard]] bool is_free(std::uint32_t added) const {
        bool free = true;
        placed_.for_each_overlap(hull_.gained(), [&](std::uint32_t slot) {
            const std::uint32_t t = placed_.model().triangle_at(slot);
            if (free && t != added && piece_of_[t] != next_piece())
                free = hull_.is_free_of(surface_.triangle(t));
        });
        return free;
    }

    PlacedModel placed_;
    const SurfaceGraph& surface_;
    PatchHull hull_;
    Pieces pieces_;
    std::vector<std::uint32_t> piece_of_, tried_; ///< by triangle; tried_: the last that did
    std::vector<std::uint32_t> in_patch_;         ///< by vertex: the last piece that has it
    std::vector<std::uint32_t> patch_, vertices_;
    std::vector<ExactPlane> planes_; ///< of the triangles
};

} // namespace

Pieces decompose(const Model& solid, const SurfaceGraph& surface) {
    return Decomposition(solid, surface).run();
}

} // namespace abut
