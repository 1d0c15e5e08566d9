#pragma once

#include "math/vector.h"
#include "rigid/model/placed_model.h"
#include "rigid/solid/prepared_faces.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// A face at an edge: the edge in the direction in which the face runs along it, and the third
/// vertex.
struct EdgeFace {
    Vec3 from, to, apex;
};

/// A surface in the world that may bound a solid, as penetration and containment query it. It is one
/// model (placed_solid.h), or a large one in mesh blocks (placed_blocks.h).
///
/// Frame       the world, or as seen from a point of it (PlacedModel::origin).
class WorldSolid {
public:
    WorldSolid() = default;
    WorldSolid(const WorldSolid&) = default;
    WorldSolid& operator=(const WorldSolid&) = delete;
    virtual ~WorldSolid() = default;

    /// Returns this surface in a frame with another origin. Only one thread may use it: it keeps
    /// triangles for later queries.
    ///
    /// In          `this` has the world's origin.
    [[nodiscard]] virtual std::unique_ptr<WorldSolid> seen_from(const Vec3& origin) const = 0;

    /// Returns whether every edge is used by exactly two triangles.
    [[nodiscard]] virtual bool closed() const = 0;
    [[nodiscard]] virtual bool bounds_solid() const = 0;
    /// Returns +1 if all normals point out, -1 if all point in, else 0.
    [[nodiscard]] virtual int outward() const = 0;
    /// Returns a vertex of each connected component.
    [[nodiscard]] virtual std::vector<Vec3> component_points() const = 0;

    /// No point of the surface is farther than reach() from middle().
    [[nodiscard]] virtual Vec3 middle() const = 0;
    [[nodiscard]] virtual double reach() const = 0;
    /// No two points of the surface are farther apart.
    [[nodiscard]] double world_size() const { return 2 * reach(); }

    /// Returns a box that encloses the surface, not always tightly.
    [[nodiscard]] virtual Box3 world_box() const = 0;

    /// In          triangle: its number in the whole mesh.
    [[nodiscard]] virtual Triangle world_triangle(std::uint32_t triangle) const = 0;
    /// Returns all faces at the edge of a triangle from its vertex number `edge` to the next.
    [[nodiscard]] virtual std::vector<EdgeFace> faces_around(std::uint32_t triangle,
                                                             std::size_t edge) const = 0;

    /// Returns whether the point lies on the surface. Exact.
    [[nodiscard]] virtual bool on_surface(const Vec3& point) const = 0;
    /// Returns whether the point lies strictly inside, by the parity of a ray's crossings.
    ///
    /// Accuracy    exact for a closed surface. With T-junctions, the majority of three rays decides.
    [[nodiscard]] bool contains(const Vec3& point) const {
        return !on_surface(point) && contains_off_surface(point);
    }
    /// As contains(), for a point that is known not to lie on the surface.
    [[nodiscard]] bool contains_off_surface(const Vec3& point) const;
    /// As above, given the answer for another point off the surface. Fast if that point is near.
    [[nodiscard]] bool contains_off_surface(const Vec3& point, const Vec3& known,
                                            bool inside) const;
    /// Returns whether the surface encloses the point. If it is not closed, the winding number decides
    /// (1 to rounding).
    [[nodiscard]] bool winds_around(const Vec3& point) const;

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Vec3 point;
        std::uint32_t slot = 0;
    };
    struct NearestSearch {
        double bound = std::numeric_limits<double>::infinity(); ///< farther points do not matter
        double enough = 0;                   ///< a point no farther than this ends the search
        double slack = 0;                    ///< relative error allowed in the distance
        const std::uint32_t* seed = nullptr; ///< a slot that is likely near
    };
    /// Returns the nearest point of the surface, if it is nearer than the bound.
    [[nodiscard]] virtual Nearest nearest(const Vec3& point, const NearestSearch& search) const = 0;
    [[nodiscard]] Nearest nearest(const Vec3& point, double bound) const {
        return nearest(point, NearestSearch{.bound = bound});
    }
    /// A slot is the surface's own number of a triangle.
    [[nodiscard]] virtual Triangle world_slot(std::uint32_t slot) const = 0;
    [[nodiscard]] virtual std::uint32_t triangle_at(std::uint32_t slot) const = 0;
    /// The triangle of a slot, prepared for many points, valid until the next query. It is kept for
    /// later calls, so only one thread may use a surface on which this is called.
    [[nodiscard]] const PreparedTriangle& prepared_slot(std::uint32_t slot) const {
        return faces_.get(slot, [&] { return world_slot(slot); });
    }

    /// A box that encloses the surface, in a frame in which the box is tight.
    struct Bounds {
        Transform frame_from_world, world_from_frame;
        Aabb box;
    };
    [[nodiscard]] virtual Bounds bounds() const = 0;

    /// A model that is the surface, or one mesh block of it. `numbers` are those of its triangles in the
    /// whole mesh, ascending; they are empty if the model is the whole mesh.
    struct Block {
        const PlacedModel& model;
        std::span<const std::uint32_t> numbers;
        Box3 box; ///< encloses it

        [[nodiscard]] std::uint32_t number(std::uint32_t triangle) const {
            return numbers.empty() ? triangle : numbers[triangle];
        }
    };
    /// Calls visit(block) for all blocks that may meet a box, in order, until it returns false.
    virtual void for_each_block(const Box3& region,
                                const std::function<bool(const Block&)>& visit) const = 0;

protected:
    /// Returns the signed crossings of a segment, as crossings() of one model does.
    [[nodiscard]] virtual std::optional<int> crossings(const Vec3& from, const Vec3& to) const = 0;
    /// Returns the winding number of the surface around a point.
    [[nodiscard]] virtual double winding(const Vec3& point) const = 0;

    [[nodiscard]] PreparedFaces& faces() const { return faces_; }

private:
    mutable PreparedFaces faces_;
};

/// Calls visit(block of a, block of b) for blocks that may meet once b is moved by `shift`, until it
/// returns false.
void for_each_block_pair(
    const WorldSolid& a, const WorldSolid& b, const Vec3& shift,
    const std::function<bool(const WorldSolid::Block&, const WorldSolid::Block&)>& visit);

/// How often a model's triangles are crossed from `from` to `to`, along their normals less against
/// them: none if the segment meets an edge or a vertex, and the count says nothing. Exact.
///
/// In          faces: if given, the model's triangles are kept there for later calls.
std::optional<int> crossings(const PlacedModel& model, const Vec3& from, const Vec3& to,
                             PreparedFaces* faces = nullptr);
/// The nearest point of one model. `faces`: as above.
WorldSolid::Nearest nearest_point(const PlacedModel& model, const Vec3& point,
                                  const WorldSolid::NearestSearch& search,
                                  PreparedFaces* faces = nullptr);

} // namespace abut
