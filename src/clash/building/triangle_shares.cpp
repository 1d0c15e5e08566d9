#include "clash/building/triangle_shares.h"

#include <algorithm>

namespace abut {

namespace {

/// Limits for one detail. A page stays fluent only if few triangles are drawn, instances counted.
struct DetailLimits {
    double bytes_share; ///< of the bytes that are left
    double drawn;       ///< triangles, each instance counted
    double least;       ///< triangles that every mesh may have
};
constexpr std::array<DetailLimits, kPartDetails> kLimits{
    {{0.75, 3e6, 500}, {0.6, 6e5, 24}, {1.0, 9e5, 12}}};

struct Sums {
    double stored = 0, drawn = 0;
};

Sums sums_with(const BuildingSource& source, const std::vector<ShownMesh>& meshes,
               PartDetail detail, double cap) {
    Sums sums;
    for (const ShownMesh& mesh : meshes)
        if (mesh.detail == detail) {
            const double triangles =
                std::min(cap, static_cast<double>(source.meshes()[mesh.mesh].triangles));
            sums.stored += triangles;
            sums.drawn += triangles * mesh.uses;
        }
    return sums;
}

/// Returns the largest number of triangles a mesh may have so that both limits hold.
double find_cap(const BuildingSource& source, const std::vector<ShownMesh>& meshes,
                PartDetail detail, double stored, double drawn) {
    const auto fits = [&](double cap) {
        const Sums sums = sums_with(source, meshes, detail, cap);
        return sums.stored <= stored && sums.drawn <= drawn;
    };
    double lower = 0, upper = 1e12;
    if (fits(upper))
        return upper;
    for (int i = 0; i < 60 && upper - lower > 0.5; ++i) {
        const double middle = 0.5 * (lower + upper);
        (fits(middle) ? lower : upper) = middle;
    }
    return lower;
}

} // namespace

std::array<double, kPartDetails> share_triangles(const BuildingSource& source, double most_bytes,
                                                 std::vector<ShownMesh>& meshes) {
    std::array<double, kPartDetails> shares{};
    double left = most_bytes / kBytesPerTriangle;
    for (std::size_t d = 0; d < kPartDetails; ++d) {
        const auto detail = static_cast<PartDetail>(d);
        const double cap = std::max(kLimits.at(d).least, find_cap(source, meshes, detail,
                                                                  left * kLimits.at(d).bytes_share,
                                                                  kLimits.at(d).drawn));
        for (ShownMesh& mesh : meshes)
            if (mesh.detail == detail)
                mesh.share = std::min(
                    1.0,
                    cap / std::max(1.0, static_cast<double>(source.meshes()[mesh.mesh].triangles)));
        const double kept = sums_with(source, meshes, detail, cap).stored;
        const double all = sums_with(source, meshes, detail, 1e18).stored;
        shares.at(d) = all > 0 ? kept / all : 1;
        left = std::max(0.0, left - kept);
    }
    return shares;
}

} // namespace abut
