#include "tests/data/ccd_frames.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace abut::test {

namespace {

struct Frame {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

/// Big-endian bytes.
std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word = word << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return word;
}

Frame read_frame(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::size_t vertices = 0, faces = 0, vertex_bytes = 0;
    std::string line, element;
    while (std::getline(stream, line) && line != "end_header") {
        std::istringstream words(line);
        std::string word, first, second;
        words >> word >> first >> second;
        if (word == "element") {
            element = first;
            (element == "vertex" ? vertices : faces) = std::stoul(second);
        }
        if (word == "property" && element == "vertex")
            vertex_bytes += first == "float" ? 4 : 1;
    }
    std::stringstream rest;
    rest << stream.rdbuf();
    const std::string bytes = rest.str();
    constexpr std::size_t kFaceBytes = 1 + 3 * 4;
    if (bytes.size() != vertices * vertex_bytes + faces * kFaceBytes)
        throw std::runtime_error(file + " has another size than its header says");
    Frame frame;
    for (std::size_t i = 0; i < vertices; ++i) {
        const auto coordinate = [&](std::size_t axis) {
            return double(std::bit_cast<float>(word_at(bytes, i * vertex_bytes + 4 * axis)));
        };
        frame.positions.push_back({coordinate(0), coordinate(1), coordinate(2)});
    }
    for (std::size_t i = 0; i < faces; ++i) {
        const std::size_t at = vertices * vertex_bytes + i * kFaceBytes + 1;
        frame.faces.push_back({word_at(bytes, at), word_at(bytes, at + 4), word_at(bytes, at + 8)});
    }
    return frame;
}

} // namespace

CcdFrames::CcdFrames(const std::string& start, const std::string& end) {
    const Frame first = read_frame(start);
    start_ = first.positions;
    end_ = read_frame(end).positions;
    faces_ = first.faces;
    // By the higher vertex, then by the lower one.
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
    const std::size_t first_edge = start_.size(), first_face = first_edge + edges_.size();
    for (const auto& pair : ids) {
        const std::size_t a = pair[0], b = pair[1];
        truth.pairs.push_back(kind == ElementaryKind::edge_edge
                                  ? edge_edge(a - first_edge, b - first_edge)
                                  : vertex_face(a, b - first_face));
    }
    return truth;
}

} // namespace abut::test
