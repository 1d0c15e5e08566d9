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

    /// Returns whether the triangles that bound the solid have no border (Solid::closed).
    [[nodiscard]] virtual bool closed() const = 0;
    [[nodiscard]] virtual bool bounds_solid() const = 0;
    /// Returns +1 if the normals of all triangles that bound the solid point out, -1 if all point
    /// in, else 0.
    [[nodiscard]] virtual int outward() const = 0;
    /// Returns +1 if the normal of a triangle points out of the solid, -1 if it points in, 0 if the
    /// triangle bounds nothing or that is not known.
    ///
    /// In          triangle: its number in the whole mesh.
    [[nodiscard]] virtual int weight(std::uint32_t triangle) const = 0;
    /// Returns whether weight() is known of all triangles that bound the solid. If not, the parity
    /// of crossings tells the inside.
    [[nodiscard]] virtual bool is_oriented() const = 0;
    /// Returns whether the transform mirrors.
    [[nodiscard]] virtual bool is_mirrored() const = 0;
    /// Returns the boundary of the solid where that is not the whole surface (SolidBoundary); else
    /// null.
    [[nodiscard]] virtual const SolidBoundary* boundary() const { return nullptr; }
    /// Returns whether boundary() tells where faces lie inside the solid: not if there are too many
    /// parts, or if shells may overlap of a mesh in blocks that is too large to examine in memory.
    [[nodiscard]] virtual bool knows_boundary() const = 0;
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

    /// Returns whether the point lies on the surface. Exact; a face that lies inside the solid, as
    /// where shells overlap, is no part of the surface.
    [[nodiscard]] virtual bool on_surface(const Vec3& point) const = 0;
    /// Returns whether the point lies strictly inside: off the surface, and the solid's boundary
    /// winds around it at least once (Solid). A ray's crossings tell how often.
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
    /// Returns whether the solid contains the point. If the surface is not closed, the winding number
    /// decides (1 or more, and an integer to rounding).
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
    /// Returns the nearest point of the surface, if it is nearer than the bound. Faces inside the
    /// solid do not count, as far as they are known (boundary()).
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

    /// As for_each_block, for the surface without the faces that lie inside its solid: their parts
    /// outside have the triangle's number.
    virtual void for_each_surface_block(const Box3& region,
                                        const std::function<bool(const Block&)>& visit) const {
        for_each_block(region, visit);
    }

protected:
    /// Returns whether a point lies on faces inside the solid.
    [[nodiscard]] virtual bool is_on_inner_face(const Vec3& /*point*/) const { return false; }
    /// Returns how often the solid's boundary winds around `from`, less around `to`; if it is not
    /// oriented, crossings() of its triangles. None if that does not tell.
    [[nodiscard]] virtual std::optional<int> crossings(const Vec3& from, const Vec3& to) const = 0;
    /// Returns the winding number of the solid's boundary around a point; if it is not oriented,
    /// that of the surface.
    [[nodiscard]] virtual double winding(const Vec3& point) const = 0;

    [[nodiscard]] PreparedFaces& faces() const { return faces_; }

private:
    /// Whether a point lies inside, by the crossings on the way from it to a point far outside.
    [[nodiscard]] bool is_inside(int crossings) const {
        return !is_oriented() ? crossings % 2 != 0 : crossings >= 1;
    }

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
/// In          faces: if given, the model's triangles are kept there for later calls. weights: if
///             not empty, by triangle: how often it counts (Solid::weights).
std::optional<int> crossings(const PlacedModel& model, const Vec3& from, const Vec3& to,
                             PreparedFaces* faces = nullptr,
                             std::span<const std::int8_t> weights = {});
/// The nearest point of one model. `faces`: as above.
WorldSolid::Nearest nearest_point(const PlacedModel& model, const Vec3& point,
                                  const WorldSolid::NearestSearch& search,
                                  PreparedFaces* faces = nullptr);

} // namespace abut
