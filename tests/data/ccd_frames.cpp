#include "tests/data/ccd_frames.h"

#include <abut/frame.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

namespace abut::test {

CcdFrames::CcdFrames(const std::string& start, const std::string& end) {
    Mesh first = read_frame(start);
    start_ = std::move(first.positions);
    end_ = read_frame(end).positions;
    faces_ = std::move(first.triangles);
    // Edges are sorted by their higher, then their lower vertex.
    for (const auto& [a, b, c] : faces_)
        for (const auto& [p, q] : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)})
            edges_.push_back({q, p});
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

ElementaryPair CcdFrames::vertex_face(std::size_t vertex, std::size_t face) const {
    const auto& [a, b, c] = faces_.at(face);
    return {ElementaryKind::vertex_face,
            {start_.at(vertex), start_[a], start_[b], start_[c]},
            {end_.at(vertex), end_[a], end_[b], end_[c]}};
}

ElementaryPair CcdFrames::edge_edge(std::size_t a, std::size_t b) const {
    const auto &p = edges_.at(a), &q = edges_.at(b);
    return {ElementaryKind::edge_edge,
            {start_[p[0]], start_[p[1]], start_[q[0]], start_[q[1]]},
            {end_[p[0]], end_[p[1]], end_[q[0]], end_[q[1]]}};
}

CcdFrames::Truth CcdFrames::read_truth(const std::string& stem, ElementaryKind kind) const {
    const auto ids = nlohmann::json::parse(std::ifstream(stem + "-pairs.json"));
    Truth truth;
    truth.collides =
        nlohmann::json::parse(std::ifstream(stem + "-collides.json")).get<std::vector<bool>>();
    const bool edges = kind == ElementaryKind::edge_edge;
    const std::size_t first_edge = start_.size(), first_face = first_edge + edges_.size();
    const std::size_t first_a = edges ? first_edge : 0, first_b = edges ? first_edge : first_face;
    for (const auto& pair : ids) {
        const std::size_t a = pair[0].get<std::size_t>() - first_a,
                          b = pair[1].get<std::size_t>() - first_b;
        truth.features.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
        truth.pairs.push_back(edges ? edge_edge(a, b) : vertex_face(a, b));
    }
    return truth;
}

} // namespace abut::test
