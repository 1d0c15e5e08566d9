#include "rigid/tolerance/sheet.h"

#include "rigid/tolerance/box_index.h"
#include "rigid/tolerance/point_order.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The unit normal of a triangle; zero if it is not higher than `thin`.
Vec3 normal_unless_thin(const Triangle& t, double thin) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double longest = std::sqrt(
        std::max({length_sq(t[1] - t[0]), length_sq(t[2] - t[1]), length_sq(t[0] - t[2])}));
    return length(normal) <= thin * longest ? Vec3{} : normalized_or_zero(normal);
}

} // namespace

Sheet::Sheet(const WorldSolid& surface, const Vec3& origin, double thin) {
    std::vector<std::pair<std::uint32_t, Triangle>> numbered;
    surface.for_each_block(surface.world_box(), [&](const WorldSolid::Block& block) {
        const auto count = block.model.data().mesh().triangles.size();
        for (std::uint32_t i = 0; i < count; ++i) {
            Triangle t = block.model.world_triangle(i);
            for (Vec3& corner : t)
                corner = corner - origin;
            numbered.emplace_back(block.number(i), t);
        }
        return true;
    });
    std::sort(numbered.begin(), numbered.end(),
              [](const auto& s, const auto& t) { return s.first < t.first; });
    std::vector<Vec3> positions;
    for (const auto& [number, t] : numbered) {
        triangles_.push_back(t);
        normals_.push_back(normal_unless_thin(t, thin));
        positions.insert(positions.end(), t.begin(), t.end());
    }
    std::sort(positions.begin(), positions.end(), is_before);
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (normals_[i] == Vec3{})
            continue;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = static_cast<std::uint32_t>(
                std::lower_bound(positions.begin(), positions.end(), triangles_[i][k], is_before) -
                positions.begin());
        for (std::uint32_t k = 0; k < 3; ++k)
            edges_.push_back({std::minmax(corners[k], corners[(k + 1) % 3]), i, k});
    }
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const auto& e, const auto& f) { return e.vertices < f.vertices; });
}

FaceSide Sheet::side(std::uint32_t triangle, std::uint32_t corner) const {
    const Triangle& t = triangles_[triangle];
    const LinePiece line{t[corner], t[(corner + 1) % 3]};
    return {line, left_of(line, normals_[triangle]), triangle};
}

std::vector<FaceSide> border_of(const Sheet& sheet, double near) {
    std::vector<FaceSide> ends;
    sheet.for_each_edge([&](std::span<const FaceSide> sides) {
        if (std::ranges::all_of(sides, [&](const FaceSide& side) {
                return same_side(side.inward, sides[0].inward);
            }))
            ends.push_back(sides[0]);
    });
    std::vector<Box3> boxes;
    for (const FaceSide& side : ends)
        boxes.push_back(box_of(side.line));
    const BoxIndex index(std::move(boxes));
    std::vector<FaceSide> border;
    for (const FaceSide& side : ends) {
        std::vector<LineSpan> covers;
        index.for_each_overlap(grown(box_of(side.line), near), [&](std::uint32_t i) {
            if (same_side(ends[i].inward, side.inward))
                return;
            if (const auto span = common_span(side.line, ends[i].line, near, 2 * near))
                covers.push_back(*span);
        });
        const Vec3 along = normalized_or_zero(side.line.q - side.line.p);
        for (const LineSpan& open : uncovered({0, length(side.line.q - side.line.p)}, covers, near))
            border.push_back({{side.line.p + open.from * along, side.line.p + open.to * along},
                              side.inward,
                              side.owner});
    }
    return border;
}

} // namespace abut
