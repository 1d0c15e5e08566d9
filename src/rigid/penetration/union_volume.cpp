#include "rigid/penetration/union_volume.h"

#include "rigid/model/face_fragments.h"
#include "rigid/model/solid.h"
#include "rigid/model/solid_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// The integral over faces for a volume, and a bound of its error.
class VolumeSum {
public:
    /// In          size: no point of a face is farther from the zero of coordinates. rounding: how far
    ///             the positions may be off.
    VolumeSum(double size, double rounding) : size_(size), rounding_(rounding) {}

    /// Adds a convex face. `weight`: +1 if its corners run counter-clockwise seen from outside; -1
    /// if clockwise.
    void add(std::span<const Vec3> corners, int weight) {
        constexpr double kRounding = 0x1p-44; // of products
        double around = 0;
        for (std::size_t i = 0; i < corners.size(); ++i)
            around += length(corners[(i + 1) % corners.size()] - corners[i]);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const Vec3 doubled = cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
            volume_ += weight * dot(corners[0], doubled) / 6;
            areas_ = areas_ + (0.5 * weight) * doubled;
            error_ += rounding_ * length(doubled);
        }
        error_ += kRounding * size_ * size_ * around;
        area_error_ += (kRounding * size_ + rounding_) * around;
    }
    /// Adds what faces may have told wrongly.
    void add(const FacesUncertainty& uncertainty, double stretch = 1) {
        const double area = stretch * stretch * uncertainty.area;
        area_error_ += area;
        error_ += area * size_ + stretch * stretch * stretch * uncertainty.volume;
    }
    /// Returns none if the faces do not close: then they contradict each other.
    [[nodiscard]] std::optional<OverlapVolume> result() const {
        if (!(length(areas_) <= area_error_))
            return std::nullopt;
        return finite_volume(volume_, error_);
    }

private:
    double size_, rounding_, volume_ = 0, error_ = 0;
    Vec3 areas_; ///< the sum of areas along their normals, which is 0 for a closed surface
    double area_error_ = 0;
};

/// How far the edges of a solid may miss each other.
double slit_width(const WorldSolid& solid) {
    const Box3 box = solid.world_box();
    return solid.closed() ? 0 : kWindingRounding * length(box.upper - box.lower);
}

/// The triangles of two solids, relative to a point, with their weights.
struct SolidFaces {
    Mesh mesh;
    std::vector<FaceFragments::Face> faces;

    void add(const WorldSolid& solid, std::uint8_t number, const Vec3& origin) {
        solid.for_each_block(solid.world_box(), [&](const WorldSolid::Block& block) {
            const auto count =
                static_cast<std::uint32_t>(block.model.data().mesh().triangles.size());
            for (std::uint32_t t = 0; t < count; ++t) {
                const int weight = solid.weight(block.number(t));
                if (weight == 0)
                    continue;
                const auto first = static_cast<std::uint32_t>(mesh.positions.size());
                for (const Vec3& p : block.model.world_triangle(t))
                    mesh.positions.push_back(p - origin);
                mesh.triangles.push_back({first, first + 1, first + 2});
                faces.push_back({number, static_cast<std::int8_t>(weight)});
            }
            return faces.size() <= kMostOverlapTriangles;
        });
    }
};

} // namespace

std::optional<OverlapVolume> union_volume(const WorldSolid& solid) {
    const Box3 box = solid.world_box();
    const Vec3 origin = 0.5 * box.lower + 0.5 * box.upper;
    VolumeSum sum(length(box.upper - box.lower), position_rounding(box) + slit_width(solid));
    // Weights are those of the stored triangles, which a mirroring transform turns over.
    const SolidBoundary& boundary = *solid.boundary();
    double stretch = 0;
    solid.for_each_surface_block(box, [&](const WorldSolid::Block& block) {
        stretch = std::max(stretch, block.model.most_stretch());
        for (std::uint32_t t = 0; t < boundary.weight.size(); ++t) {
            Triangle corners = block.model.world_triangle(t);
            for (Vec3& p : corners)
                p = p - origin;
            if (boundary.weight[t] != 0)
                sum.add(corners, solid.is_mirrored() ? -boundary.weight[t] : boundary.weight[t]);
        }
        return true;
    });
    sum.add(boundary.uncertainty, stretch);
    return sum.result();
}

std::optional<OverlapVolume> union_overlap_volume(const WorldSolid& a, const WorldSolid& b) {
    const Box3 box_a = a.world_box(), box_b = b.world_box();
    const Box3 common{max(box_a.lower, box_b.lower), min(box_a.upper, box_b.upper)};
    if (is_empty(common))
        return OverlapVolume{};
    const Vec3 origin = 0.5 * common.lower + 0.5 * common.upper;
    SolidFaces both;
    both.add(a, 0, origin), both.add(b, 1, origin);
    if (both.faces.size() > kMostOverlapTriangles)
        return std::nullopt;
    const double rounding = std::max(position_rounding(box_a), position_rounding(box_b));
    VolumeSum sum(
        2 * std::max(length(box_a.upper - box_a.lower), length(box_b.upper - box_b.lower)),
        rounding + slit_width(a) + slit_width(b));
    FaceFragments fragments(std::move(both.mesh), std::move(both.faces), rounding);
    const bool is_complete = fragments.for_each([&](const FaceFragments::Fragment& f) {
        const bool over = f.sides.over[0] >= 1 && f.sides.over[1] >= 1,
                   under = f.sides.under[0] >= 1 && f.sides.under[1] >= 1;
        if (over != under && f.sides.is_first)
            sum.add(f.corners, under ? 1 : -1);
    });
    if (!is_complete)
        return std::nullopt;
    sum.add(fragments.uncertainty());
    return sum.result();
}

double position_rounding(const Box3& box) {
    return 0x1p-50 * std::max(max_abs(box.lower), max_abs(box.upper));
}

std::optional<OverlapVolume> finite_volume(double volume, double error) {
    if (!std::isfinite(volume) || !std::isfinite(error))
        return std::nullopt;
    return OverlapVolume{std::max(volume, 0.0), error};
}

} // namespace abut
