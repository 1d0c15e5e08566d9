#pragma once

#include <abut/elementary_impact.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::test {

/// Two frames of the ccd data set and their features, numbered as IDS.md there says.
class CcdFrames {
public:
    /// The arguments are paths of frames for read_frame.
    CcdFrames(const std::string& start, const std::string& end);

    [[nodiscard]] ElementaryPair vertex_face(std::size_t vertex, std::size_t face) const;
    [[nodiscard]] ElementaryPair edge_edge(std::size_t a, std::size_t b) const;

    struct Truth {
        /// Numbered as in IDS.md: two edges, the lower first, or vertex and triangle.
        std::vector<std::array<std::uint32_t, 2>> features;
        std::vector<ElementaryPair> pairs;
        std::vector<bool> collides;
    };
    /// The pairs of box ids in STEM-pairs.json, and their answers in STEM-collides.json.
    [[nodiscard]] Truth read_truth(const std::string& stem, ElementaryKind kind) const;

private:
    std::vector<Vec3> start_, end_;
    std::vector<std::array<std::uint32_t, 3>> faces_;
    std::vector<std::array<std::uint32_t, 2>> edges_;
};

} // namespace abut::test
