#include "rigid/tolerance/sheet.h"

#include "rigid/tolerance/point_order.h"

#include <algorithm>

namespace abut {

Sheet::Sheet(const WorldSolid& surface) {
    std::vector<std::pair<std::uint32_t, Triangle>> numbered;
    surface.for_each_block(surface.world_box(), [&](const WorldSolid::Block& block) {
        const auto count = block.model.data().mesh().triangles.size();
        for (std::uint32_t i = 0; i < count; ++i)
            numbered.emplace_back(block.number(i), block.model.world_triangle(i));
        return true;
    });
    std::sort(numbered.begin(), numbered.end(),
              [](const auto& s, const auto& t) { return s.first < t.first; });
    for (const auto& [number, t] : numbered)
        positions_.insert(positions_.end(), t.begin(), t.end());
    std::sort(positions_.begin(), positions_.end(), is_before);
    positions_.erase(std::unique(positions_.begin(), positions_.end()), positions_.end());
    sorted_ = positions_.size();
    for (const auto& [number, t] : numbered)
        add(t);
}

/// The number of the vertex at a position; a new one if there is none.
std::uint32_t Sheet::vertex_at(const Vec3& position) {
    const auto end = positions_.begin() + static_cast<std::ptrdiff_t>(sorted_);
    if (const auto at = std::lower_bound(positions_.begin(), end, position, is_before);
        at != end && *at == position)
        return static_cast<std::uint32_t>(at - positions_.begin());
    const auto at = std::find(end, positions_.end(), position);
    const auto number = static_cast<std::uint32_t>(at - positions_.begin());
    if (at == positions_.end())
        positions_.push_back(position);
    return number;
}

std::vector<Sheet::Edge> Sheet::edges_of_faces() const {
    std::vector<std::array<std::uint32_t, 3>> faces = corners_;
    for (auto& face : faces)
        std::sort(face.begin(), face.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::vector<Edge> edges;
    for (const auto& [p, q, r] : faces) {
        edges.emplace_back(p, q);
        edges.emplace_back(q, r);
        edges.emplace_back(p, r);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::vector<std::uint32_t> Sheet::pieces_of(std::uint32_t number) const {
    std::vector<std::uint32_t> pieces{number};
    if (const auto more = more_pieces_.find(number); more != more_pieces_.end())
        pieces.insert(pieces.end(), more->second.begin(), more->second.end());
    return pieces;
}

void Sheet::add(const Triangle& t) {
    triangles_.push_back(t);
    corners_.push_back({vertex_at(t[0]), vertex_at(t[1]), vertex_at(t[2])});
}

void Sheet::replace(std::uint32_t number, const std::vector<FacePolygon>& pieces) {
    bool is_first = true;
    for (const FacePolygon& piece : pieces)
        for (std::size_t k = 2; k < piece.size(); ++k) {
            if (!is_first)
                more_pieces_[number].push_back(static_cast<std::uint32_t>(triangles_.size()));
            add({piece[0], piece[k - 1], piece[k]});
            if (is_first) {
                triangles_[number] = triangles_.back();
                corners_[number] = corners_.back();
                triangles_.pop_back();
                corners_.pop_back();
            }
            is_first = false;
        }
}

} // namespace abut
