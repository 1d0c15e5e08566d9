#include "view/levels/quantised_chunk.h"

#include "math/rounding.h"
#include "view/levels/closed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace abut {

namespace {

constexpr double kLast = 65535;
constexpr double kLeastErrorExponent = -20;

/// The exponent of the least power of two that is at least v.
int ceil_exponent(double v) {
    int exponent = 0;
    const double mantissa = std::frexp(v, &exponent);
    return mantissa == 0.5 ? exponent - 1 : exponent;
}

struct VertexHash {
    std::size_t operator()(const ChunkVertex& v) const {
        constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
        std::uint64_t hash = std::uint64_t{v.position[0]} | std::uint64_t{v.position[1]} << 16 |
                             std::uint64_t{v.position[2]} << 32;
        hash = (hash ^ hash >> 29) * kOdd;
        hash ^= static_cast<std::uint8_t>(v.normal[0]) |
                std::uint64_t{static_cast<std::uint8_t>(v.normal[1])} << 8 |
                std::uint64_t{v.part} << 16;
        hash = (hash ^ hash >> 32) * kOdd;
        return hash ^ hash >> 32;
    }
};

} // namespace

std::uint8_t code_of_error(double error) {
    if (!(error > 0))
        return 0;
    const double steps = std::ceil(8 * (std::log2(error) - kLeastErrorExponent)) + 1;
    auto code = static_cast<std::uint8_t>(std::clamp(steps, 1.0, 255.0));
    while (code < 255 && error_of_code(code) < error) // the logarithm was rounded
        ++code;
    return code;
}

double error_of_code(std::uint8_t code) {
    return code == 0     ? 0
           : code == 255 ? std::numeric_limits<double>::infinity()
                         : std::exp2(kLeastErrorExponent + (code - 1) / 8.0);
}

double ChunkGrid::step() const {
    return std::ldexp(1.0, exponent);
}

double ChunkGrid::error() const {
    return std::sqrt(0.75) * step();
}

ChunkGrid grid_of(const Box3& box, int least_exponent) {
    const Vec3 extent = box.upper - box.lower;
    // Half a step is left at either end, so that rounding stays inside.
    int exponent = std::max(least_exponent, ceil_exponent(max_abs(extent) / (kLast - 1)));
    // Multiples of the step must be floats.
    const double farthest = std::max(max_abs(box.lower), max_abs(box.upper));
    exponent = std::max(exponent, ceil_exponent(farthest) - 23);
    exponent = std::max(exponent, -100);
    ChunkGrid grid;
    grid.exponent = exponent;
    for (int k = 0; k < 3; ++k)
        grid.lower.at(static_cast<std::size_t>(k)) =
            std::llround(std::ldexp(component(box.lower, k), -exponent));
    return grid;
}

namespace {

/// Lists the parts that triangles show, and returns their new numbers.
std::vector<std::uint32_t> used_parts(const LevelSurface& surface, double rounding, PartChunk& to) {
    std::vector<std::uint32_t> number_of(std::max<std::size_t>(surface.parts.size(), 1), 0);
    for (const auto& t : surface.triangles)
        number_of[surface.vertices[t[0]].part] = 1;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < surface.parts.size(); ++i) {
        if (number_of[i] == 0)
            continue;
        number_of[i] = count++;
        to.parts.push_back(surface.parts[i]);
        to.errors.push_back(code_of_error(surface.errors[i] + rounding));
    }
    return number_of;
}

} // namespace

PartChunk quantise(const LevelSurface& surface, const ChunkGrid& grid, bool keep_flat) {
    PartChunk result;
    const std::vector<std::uint32_t> part = used_parts(surface, grid.error(), result);
    ViewChunk& chunk = result.chunk;
    for (std::size_t k = 0; k < 3; ++k) {
        chunk.lower.at(k) =
            to_float(std::ldexp(static_cast<double>(grid.lower.at(k)), grid.exponent));
        chunk.step.at(k) = to_float(grid.step());
    }
    if (surface.resting > 0)
        result.resting = std::nextafter(to_float(surface.resting + grid.error()), HUGE_VALF);
    const auto rounded = [&](const SurfaceVertex& v) {
        ChunkVertex to{{}, v.normal, part[v.part]};
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = std::nearbyint(std::ldexp(component(v.position, static_cast<int>(k)),
                                                        -grid.exponent)) -
                              static_cast<double>(grid.lower.at(k));
            to.position.at(k) = static_cast<std::uint16_t>(std::clamp(at, 0.0, kLast));
        }
        return to;
    };
    std::vector<std::array<ChunkVertex, 3>> triangles;
    triangles.reserve(surface.triangles.size());
    for (const auto& t : surface.triangles) {
        const std::array<ChunkVertex, 3> corners{rounded(surface.vertices[t[0]]),
                                                 rounded(surface.vertices[t[1]]),
                                                 rounded(surface.vertices[t[2]])};
        const bool is_flat = corners[0].position == corners[1].position ||
                             corners[1].position == corners[2].position ||
                             corners[2].position == corners[0].position;
        if (!is_flat || keep_flat)
            triangles.push_back(corners);
    }
    chunk.closed_triangles = put_closed_first(triangles);
    std::unordered_map<ChunkVertex, std::uint16_t, VertexHash> number_of;
    number_of.reserve(surface.vertices.size());
    for (const auto& corners : triangles)
        for (const ChunkVertex& corner : corners) {
            const auto [found, is_new] =
                number_of.try_emplace(corner, static_cast<std::uint16_t>(chunk.vertices.size()));
            if (is_new)
                chunk.vertices.push_back(corner);
            chunk.indices.push_back(found->second);
        }
    return result;
}

LevelSurface surface_of(const PartChunk& from) {
    LevelSurface surface;
    surface.parts = from.parts;
    surface.resting = double{from.resting};
    for (const std::uint8_t code : from.errors)
        surface.errors.push_back(error_of_code(code));
    const ViewChunk& chunk = from.chunk;
    surface.vertices.reserve(chunk.vertices.size());
    for (const ChunkVertex& v : chunk.vertices) {
        const auto at = [&](std::size_t k) {
            return double{chunk.lower.at(k)} + double{chunk.step.at(k)} * v.position.at(k);
        };
        surface.vertices.push_back({{at(0), at(1), at(2)}, v.normal, v.part});
    }
    surface.triangles.reserve(chunk.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < chunk.indices.size(); i += 3)
        surface.triangles.push_back({chunk.indices[i], chunk.indices[i + 1], chunk.indices[i + 2]});
    return surface;
}

} // namespace abut
