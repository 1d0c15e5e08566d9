#include "render/triangle_runs.h"

#include <algorithm>

namespace abut {

namespace {

/// Triangles of a run. In software, drawing so many costs a hundred times as much as to test their
/// box.
constexpr std::uint32_t kTriangles = 64;

TriangleRun run_of(const ViewChunk& chunk, std::uint32_t first, std::uint32_t end) {
    std::array<std::uint16_t, 3> least{0xffff, 0xffff, 0xffff}, most{};
    for (std::uint32_t i = first; i < end; ++i) {
        const auto& position = chunk.vertices[chunk.indices[i]].position;
        for (std::size_t k = 0; k < 3; ++k) {
            least.at(k) = std::min(least.at(k), position.at(k));
            most.at(k) = std::max(most.at(k), position.at(k));
        }
    }
    TriangleRun run;
    run.first = first, run.end = end;
    for (std::size_t k = 0; k < 3; ++k) {
        run.lower.at(k) = chunk.lower.at(k) + chunk.step.at(k) * static_cast<float>(least.at(k));
        run.upper.at(k) = chunk.lower.at(k) + chunk.step.at(k) * static_cast<float>(most.at(k));
    }
    return run;
}

} // namespace

std::vector<TriangleRun> triangle_runs(const ViewChunk& chunk) {
    const auto count = static_cast<std::uint32_t>(chunk.indices.size());
    const std::uint32_t closed = 3 * chunk.closed_triangles;
    std::vector<TriangleRun> runs;
    runs.reserve(count / (3 * kTriangles) + 2);
    for (std::uint32_t first = 0; first < count; first = runs.back().end)
        runs.push_back(run_of(chunk, first,
                              std::min(first < closed ? closed : count, first + 3 * kTriangles)));
    return runs;
}

} // namespace abut
