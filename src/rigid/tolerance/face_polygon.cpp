#include "rigid/tolerance/face_polygon.h"

#include <algorithm>
#include <cmath>

namespace abut {

CutPolygon cut(const FacePolygon& polygon, const CuttingPlane& plane, double rounding) {
    boost::container::static_vector<double, FacePolygon::static_capacity> over;
    double highest = -1, lowest = 1;
    for (const Vec3& corner : polygon) {
        over.push_back(dot(corner - plane.point, plane.normal));
        if (std::abs(over.back()) <= rounding)
            over.back() = 0;
        highest = std::max(highest, over.back());
        lowest = std::min(lowest, over.back());
    }
    if (highest <= 0)
        return {polygon, {}};
    if (lowest >= 0)
        return {{}, polygon};
    CutPolygon parts;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = (i + 1) % polygon.size();
        if (over[i] <= 0)
            parts.inside.push_back(polygon[i]);
        if (over[i] >= 0)
            parts.outside.push_back(polygon[i]);
        if ((over[i] < 0 && over[j] > 0) || (over[i] > 0 && over[j] < 0)) {
            const Vec3 on =
                polygon[i] + (over[i] / (over[i] - over[j])) * (polygon[j] - polygon[i]);
            parts.inside.push_back(on);
            parts.outside.push_back(on);
        }
    }
    return parts;
}

CutPolygon halved(const FacePolygon& polygon, double rounding) {
    Vec3 along;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j)
            if (const Vec3 diagonal = polygon[j] - polygon[i];
                length_sq(diagonal) > length_sq(along))
                along = diagonal;
    const Vec3 middle = middle_of(polygon);
    return cut(polygon, {middle, normalized_or_zero(along)}, rounding);
}

Vec3 middle_of(const FacePolygon& polygon) {
    Vec3 sum;
    for (const Vec3& corner : polygon)
        sum = sum + (corner - polygon[0]);
    return polygon[0] + (1.0 / static_cast<double>(polygon.size())) * sum;
}

double reach_from(const FacePolygon& polygon, const Vec3& point) {
    double reach_sq = 0;
    for (const Vec3& corner : polygon)
        reach_sq = std::max(reach_sq, length_sq(corner - point));
    return std::sqrt(reach_sq);
}

Box3 box_of(const FacePolygon& polygon) {
    Box3 box;
    for (const Vec3& corner : polygon)
        extend(box, corner);
    return box;
}

} // namespace abut
