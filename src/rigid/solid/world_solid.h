#pragma once

#include "math/vector.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// A face around an edge: the edge as the face runs along it, and its third vertex.
struct EdgeFace {
    Vec3 from, to, apex;
};

/// A surface in the world that may bound a solid: what is asked of either of two that meet. It is
/// one model (placed_solid.h), or a large one in blocks (placed_blocks.h).
///
/// Frame       the world, or as seen from a point of it (PlacedModel::origin).
class WorldSolid {
public:
    WorldSolid() = default;
    WorldSolid(const WorldSolid&) = default;
    WorldSolid& operator=(const WorldSolid&) = delete;
    virtual ~WorldSolid() = default;

    /// The same surface in a frame with another origin. In: `this` has the origin of the world.
    [[nodiscard]] virtual std::unique_ptr<WorldSolid> seen_from(const Vec3& origin) const = 0;

    /// Every edge is used by exactly two triangles.
    [[nodiscard]] virtual bool closed() const = 0;
    [[nodiscard]] virtual bool bounds_solid() const = 0;
    /// +1: normals point out; -1: they point in; 0: neither everywhere.
    [[nodiscard]] virtual int outward() const = 0;
    /// A vertex of each connected component.
    [[nodiscard]] virtual std::vector<Vec3> component_points() const = 0;

    /// No point of the surface is farther than reach() from middle().
    [[nodiscard]] virtual Vec3 middle() const = 0;
    [[nodiscard]] virtual double reach() const = 0;
    /// No two points of the surface are farther apart.
    [[nodiscard]] double world_size() const { return 2 * reach(); }

    /// Holds the surface, more or less tightly.
    [[nodiscard]] virtual Box3 world_box() const = 0;

    /// By its number in the whole.
    [[nodiscard]] virtual Triangle world_triangle(std::uint32_t triangle) const = 0;
    /// All faces at the edge of a triangle from its vertex number `edge` to the next.
    [[nodiscard]] virtual std::vector<EdgeFace> faces_around(std::uint32_t triangle,
                                                             std::size_t edge) const = 0;

    /// Whether the point lies on the surface. Exact.
    [[nodiscard]] virtual bool on_surface(const Vec3& point) const = 0;
    /// Whether the point lies strictly inside, by the parity of crossings of a ray.
    ///
    /// Accuracy    exact for a closed surface; with T-junctions, the majority of three rays. False on
    ///             the surface.
    [[nodiscard]] bool contains(const Vec3& point) const {
        return !on_surface(point) && contains_off_surface(point);
    }
    /// The same for a point that is known not to lie on the surface.
    [[nodiscard]] bool contains_off_surface(const Vec3& point) const;
    /// The same, where it is known of another point off the surface; fast where that is near.
    [[nodiscard]] bool contains_off_surface(const Vec3& point, const Vec3& known,
                                            bool inside) const;
    /// A part inside the other: for a surface that is not closed the winding number decides (1 to
    /// rounding).
    [[nodiscard]] bool winds_around(const Vec3& point) const;

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Vec3 point;
        std::uint32_t slot = 0;
    };
    struct NearestSearch {
        double bound = std::numeric_limits<double>::infinity(); ///< nothing farther matters
        double enough = 0;                   ///< a point no farther than this ends the search
        double slack = 0;                    ///< the distance may be this much too large, relative
        const std::uint32_t* seed = nullptr; ///< a slot that is likely near
    };
    /// The surface's nearest point, if it is nearer than the bound.
    [[nodiscard]] virtual Nearest nearest(const Vec3& point, const NearestSearch& search) const = 0;
    [[nodiscard]] Nearest nearest(const Vec3& point, double bound) const {
        return nearest(point, NearestSearch{.bound = bound});
    }
    /// Slots are the surface's own numbers of triangles.
    [[nodiscard]] virtual Triangle world_slot(std::uint32_t slot) const = 0;
    [[nodiscard]] virtual std::uint32_t triangle_at(std::uint32_t slot) const = 0;

    /// A box that holds the surface, in a frame in which it is tight.
    struct Bounds {
        Transform frame_from_world, world_from_frame;
        Aabb box;
    };
    [[nodiscard]] virtual Bounds bounds() const = 0;

    /// A model that the surface consists of. numbers: of its triangles in the whole, ascending;
    /// empty: they are the whole.
    struct Block {
        const PlacedModel& model;
        std::span<const std::uint32_t> numbers;
        Box3 box; ///< holds it

        [[nodiscard]] std::uint32_t number(std::uint32_t triangle) const {
            return numbers.empty() ? triangle : numbers[triangle];
        }
    };
    /// Calls visit(block) for all that may meet a box, in their order, until it returns false.
    virtual void for_each_block(const Box3& region,
                                const std::function<bool(const Block&)>& visit) const = 0;

protected:
    /// As of one model, below.
    [[nodiscard]] virtual std::optional<int> crossings(const Vec3& from, const Vec3& to) const = 0;
    /// How often the surface winds around a point.
    [[nodiscard]] virtual double winding(const Vec3& point) const = 0;
};

/// Calls visit(block of a, block of b) for blocks that may meet once b is moved by `shift`, until it
/// returns false.
void for_each_block_pair(
    const WorldSolid& a, const WorldSolid& b, const Vec3& shift,
    const std::function<bool(const WorldSolid::Block&, const WorldSolid::Block&)>& visit);

/// How often a model's triangles are crossed from `from` to `to`, along their normals less against
/// them: none if the segment meets an edge or a vertex, and the count says nothing. Exact.
std::optional<int> crossings(const PlacedModel& model, const Vec3& from, const Vec3& to);
/// The nearest point of one model.
WorldSolid::Nearest nearest_point(const PlacedModel& model, const Vec3& point,
                                  const WorldSolid::NearestSearch& search);

} // namespace abut
