#include "rigid/tolerance/sheet_slits.h"

#include "rigid/tolerance/face_polygon.h"
#include "rigid/tolerance/point_order.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr std::size_t kMostSlits = 1000;

/// A slit lies in a plane, and reaches as far from a point in it as is wanted.
struct Slit {
    Vec3 at;      ///< where the border passes through the surface
    Vec3 outward; ///< unit normal of the plane, away from the other surface at its border
};

/// The point of a side in a plane. The same for both directions of the side.
Vec3 point_between(Vec3 p, Vec3 q, double height_p, double height_q) {
    if (is_before(q, p))
        std::swap(p, q), std::swap(height_p, height_q);
    return p + (height_p / (height_p - height_q)) * (q - p);
}

/// Divides a polygon by a plane, so that neighbours are divided at the same points.
CutPolygon divide(const FacePolygon& polygon, const CuttingPlane& plane) {
    CutPolygon parts;
    const auto height = [&](const Vec3& p) { return dot(p - plane.point, plane.normal); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = height(p), at_q = height(q);
        (at_p <= 0 ? parts.inside : parts.outside).push_back(p);
        if ((at_p <= 0) == (at_q <= 0))
            continue;
        const Vec3 on = point_between(p, q, at_p, at_q);
        parts.inside.push_back(on);
        parts.outside.push_back(on);
    }
    return parts;
}

void keep(const FacePolygon& polygon, std::vector<FacePolygon>& pieces) {
    if (polygon.size() < 3)
        return;
    if (polygon.size() <= kMostCornersToCut)
        return pieces.push_back(polygon);
    for (std::size_t k = 2; k < polygon.size(); ++k)
        pieces.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

/// Cuts one slit into a piece of a triangle: the points of the slit that are within `reach` of its
/// middle. So of two triangles at an edge, both are cut where one is.
void cut_slit(const FacePolygon& piece, const Vec3& normal, const Slit& slit, double reach,
              double width, std::vector<FacePolygon>& pieces) {
    const Vec3 along = normalized_or_zero(cross(normal, slit.outward)),
               across = cross(slit.outward, along);
    const double slope = dot(across, normal);
    const double aside = slope == 0 ? reach : dot(piece[0] - slit.at, normal) / slope;
    if (along == Vec3{} || !(std::abs(aside) < reach))
        return keep(piece, pieces);
    const double half = std::sqrt(reach * reach - aside * aside);
    const CutPolygon first = divide(piece, {slit.at + half * along, along});
    keep(first.outside, pieces);
    const CutPolygon last = divide(first.inside, {slit.at - half * along, -along});
    keep(last.outside, pieces);
    const Vec3 edge = 0.5 * width * slit.outward;
    keep(divide(last.inside, {slit.at - edge, slit.outward}).inside, pieces);
    keep(divide(last.inside, {slit.at + edge, slit.outward}).outside, pieces);
}

Slit slit_of(const BorderCrossing& crossing, const Sheet& sheet) {
    const Triangle &t = crossing.border, &u = sheet.triangle(crossing.crossed);
    const Vec3 &p = t[crossing.edge], &q = t[(crossing.edge + 1) % 3];
    const Vec3 across = cross(u[1] - u[0], u[2] - u[0]);
    const double at_p = dot(p - u[0], across), at_q = dot(q - u[0], across);
    const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    const double share = at_p == at_q ? 0.5 : std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
    return {p + share * (q - p), normalized_or_zero(cross(q - p, normal))};
}

} // namespace

void cut_slits(Sheet& sheet, std::span<const BorderCrossing> crossings, double tolerance,
               double width) {
    // Where the surfaces cross at 30 degrees, what goes beyond by the tolerance is twice as long.
    const double reach = 2 * tolerance + width;
    const std::size_t count = sheet.triangles();
    std::vector<Slit> slits;
    for (const BorderCrossing& crossing : crossings.first(std::min(kMostSlits, crossings.size())))
        if (const Slit slit = slit_of(crossing, sheet); slit.outward != Vec3{})
            slits.push_back(slit);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = sheet.triangle(i);
        Box3 box;
        for (const Vec3& corner : t)
            extend(box, corner);
        const Box3 near = grown(box, reach);
        const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        std::vector<FacePolygon> pieces;
        for (const Slit& slit : slits) {
            if (!encloses(near, {slit.at, slit.at}))
                continue;
            if (pieces.empty())
                pieces.push_back({t[0], t[1], t[2]});
            std::vector<FacePolygon> divided;
            for (const FacePolygon& piece : pieces)
                cut_slit(piece, normal, slit, reach, width, divided);
            pieces = std::move(divided);
        }
        if (!pieces.empty())
            sheet.replace(i, pieces);
    }
}

} // namespace abut
