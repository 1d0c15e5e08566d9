#include "rigid/tolerance/sheet.h"

#include "math/point_order.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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
    for (const auto& [number, t] : numbered) {
        triangles_.push_back(t);
        normals_.push_back(normal_unless_thin(t, thin));
    }
    connect();
}

/// The edges of all triangles that are not thin, sorted by their vertices.
std::vector<Sheet::EdgeOfTriangle> Sheet::edges() const {
    std::vector<Vec3> positions;
    for (const Triangle& t : triangles_)
        positions.insert(positions.end(), t.begin(), t.end());
    std::sort(positions.begin(), positions.end(),
              [](const Vec3& p, const Vec3& q) { return is_before(p, q); });
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    std::vector<EdgeOfTriangle> edges;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (normals_[i] == Vec3{})
            continue;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = static_cast<std::uint32_t>(
                std::lower_bound(positions.begin(), positions.end(), triangles_[i][k],
                                 [](const Vec3& p, const Vec3& q) { return is_before(p, q); }) -
                positions.begin());
        for (std::uint32_t k = 0; k < 3; ++k)
            edges.push_back({std::minmax(corners[k], corners[(k + 1) % 3]), i, k});
    }
    std::sort(edges.begin(), edges.end(), [](const auto& e, const auto& f) {
        return std::tie(e.vertices, e.triangle) < std::tie(f.vertices, f.triangle);
    });
    return edges;
}

FaceSide Sheet::side(const EdgeOfTriangle& edge) const {
    const Triangle& t = triangles_[edge.triangle];
    const LinePiece line{t[edge.corner], t[(edge.corner + 1) % 3]};
    return {line, left_of(line, normals_[edge.triangle]), edge.triangle};
}

/// Finds the neighbours of all triangles, and the loose sides.
void Sheet::connect() {
    const std::vector<EdgeOfTriangle> edges = this->edges();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        bool is_loose = true;
        const Vec3 inward = side(edges[first]).inward;
        for (last = first; last < edges.size() && edges[last].vertices == edges[first].vertices;
             ++last)
            is_loose = is_loose && same_side(side(edges[last]).inward, inward);
        for (std::size_t i = first; i < last; ++i) {
            if (is_loose)
                loose_.push_back(side(edges[i]));
            if (i > first) { // each with the one before is enough to connect all
                pairs.emplace_back(edges[i].triangle, edges[i - 1].triangle);
                pairs.emplace_back(edges[i - 1].triangle, edges[i].triangle);
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    first_neighbour_.assign(triangles_.size() + 1, 0);
    for (const auto& [triangle, neighbour] : pairs) {
        ++first_neighbour_[triangle + 1];
        neighbours_.push_back(neighbour);
    }
    for (std::size_t i = 1; i < first_neighbour_.size(); ++i)
        first_neighbour_[i] += first_neighbour_[i - 1];
    std::vector<Box3> boxes;
    for (const FaceSide& loose : loose_)
        boxes.push_back(box_of(loose.line));
    loose_index_ = BoxIndex(std::move(boxes));
}

std::vector<FaceSide> border_of(const Sheet& sheet, double near) {
    std::vector<FaceSide> border;
    for (const FaceSide& side : sheet.loose_sides()) {
        const Vec3 along = normalized_or_zero(side.line.q - side.line.p);
        std::vector<LineSpan> covers;
        sheet.for_each_loose(grown(box_of(side.line), near), [&](std::uint32_t i) {
            const FaceSide& other = sheet.loose_sides()[i];
            if (same_side(other.inward, side.inward))
                return;
            if (const auto span = common_span(side.line, along, other.line, near, 2 * near))
                covers.push_back(*span);
        });
        for (const LineSpan& open : uncovered({0, length(side.line.q - side.line.p)}, covers, near))
            border.push_back({{side.line.p + open.from * along, side.line.p + open.to * along},
                              side.inward,
                              side.owner});
    }
    return border;
}

} // namespace abut
