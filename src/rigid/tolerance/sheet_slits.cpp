#include "rigid/tolerance/sheet_slits.h"

#include "rigid/tolerance/face_polygon.h"
#include "rigid/tolerance/point_order.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr std::size_t kMostSlits = 1000;

/// The plane of a slit, and how far it reaches.
struct Slit {
    Vec3 at;      ///< where the border passes through the surface
    Vec3 outward; ///< unit vector in the other surface, away from it at the border
    Vec3 normal;  ///< unit vector, of the other surface
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

/// Cuts one slit into a piece.
void cut_slit(const FacePolygon& piece, const Slit& slit, double tolerance, double width,
              std::vector<FacePolygon>& pieces) {
    const CutPolygon top = divide(piece, {slit.at + tolerance * slit.normal, slit.normal});
    keep(top.outside, pieces);
    const CutPolygon bottom = divide(top.inside, {slit.at - tolerance * slit.normal, -slit.normal});
    keep(bottom.outside, pieces);
    const Vec3 half = 0.5 * width * slit.outward;
    keep(divide(bottom.inside, {slit.at - half, slit.outward}).inside, pieces);
    keep(divide(bottom.inside, {slit.at + half, slit.outward}).outside, pieces);
}

Slit slit_of(const BorderCrossing& crossing, const Sheet& sheet) {
    const Triangle &t = crossing.border, &u = sheet.triangle(crossing.crossed);
    const Vec3 &p = t[crossing.edge], &q = t[(crossing.edge + 1) % 3];
    const Vec3 across = cross(u[1] - u[0], u[2] - u[0]);
    const double at_p = dot(p - u[0], across), at_q = dot(q - u[0], across);
    const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    const double share = at_p == at_q ? 0.5 : std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
    return {p + share * (q - p), normalized_or_zero(cross(q - p, normal)), normal};
}

} // namespace

void cut_slits(Sheet& sheet, std::span<const BorderCrossing> crossings, double tolerance,
               double width) {
    const std::size_t count = sheet.triangles();
    std::vector<Slit> slits;
    for (const BorderCrossing& crossing : crossings.first(std::min(kMostSlits, crossings.size())))
        if (const Slit slit = slit_of(crossing, sheet);
            slit.outward != Vec3{} && slit.normal != Vec3{})
            slits.push_back(slit);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = sheet.triangle(i);
        Box3 box;
        for (const Vec3& corner : t)
            extend(box, corner);
        const Box3 near = grown(box, tolerance + width);
        std::vector<FacePolygon> pieces;
        for (const Slit& slit : slits) {
            if (!encloses(near, {slit.at, slit.at}))
                continue;
            if (pieces.empty())
                pieces.push_back({t[0], t[1], t[2]});
            std::vector<FacePolygon> divided;
            for (const FacePolygon& piece : pieces)
                cut_slit(piece, slit, tolerance + width, width, divided);
            pieces = std::move(divided);
        }
        if (!pieces.empty())
            sheet.replace(i, pieces);
    }
}

} // namespace abut
