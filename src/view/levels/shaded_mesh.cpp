#include "view/levels/shaded_mesh.h"

#include "math/transform.h"
#include "mesh/equal_positions.h"
#include "view/simplify/packed_normal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace abut {

namespace {

constexpr double kCosCrease = 0.8191520442889918; // of 35 degrees
/// Around a vertex with more faces than this, a normal is the mean of groups of faces.
constexpr std::size_t kMostPairwise = 48;

/// The corners of all triangles, sorted by the position that they lie at.
struct CornersByPosition {
    std::vector<std::uint32_t> first;   ///< by position: its first corner; one more at the end
    std::vector<std::uint32_t> corners; ///< 3 * triangle + k
};

CornersByPosition sort_corners(const Mesh& mesh, const std::vector<std::uint32_t>& position_of) {
    CornersByPosition result;
    result.first.assign(mesh.positions.size() + 1, 0);
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t)
            ++result.first[position_of[v] + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.corners.resize(3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
    for (std::uint32_t i = 0; i < result.corners.size(); ++i)
        result.corners[next[position_of[mesh.triangles[i / 3].at(i % 3)]]++] = i;
    return result;
}

double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = normalized_or_zero(b - a), v = normalized_or_zero(c - a);
    return std::acos(std::clamp(dot(u, v), -1.0, 1.0));
}

class CornerNormals {
public:
    /// In          side: -1 if the transform mirrors, else 1.
    CornerNormals(const Mesh& mesh, const std::vector<Vec3>& placed,
                  const std::vector<std::uint32_t>& position_of, double side)
        : mesh_(mesh), placed_(placed) {
        normals_.resize(3 * mesh.triangles.size());
        face_.reserve(mesh.triangles.size());
        for (const auto& [a, b, c] : mesh.triangles)
            face_.push_back(
                side * normalized_or_zero(cross(placed[b] - placed[a], placed[c] - placed[a])));
        const CornersByPosition sorted = sort_corners(mesh, position_of);
        for (std::size_t p = 0; p + 1 < sorted.first.size(); ++p)
            smooth(std::span(sorted.corners)
                       .subspan(sorted.first[p], sorted.first[p + 1] - sorted.first[p]));
    }

    [[nodiscard]] PackedNormal operator()(std::uint32_t corner) const { return normals_[corner]; }

private:
    [[nodiscard]] Vec3 weighted(std::uint32_t corner) const {
        const auto& t = mesh_.triangles[corner / 3];
        const std::uint32_t k = corner % 3;
        return angle_at(placed_[t.at(k)], placed_[t.at((k + 1) % 3)], placed_[t.at((k + 2) % 3)]) *
               face_[corner / 3];
    }

    void smooth(std::span<const std::uint32_t> corners) {
        if (corners.size() > kMostPairwise)
            return smooth_groups(corners);
        std::array<Vec3, kMostPairwise> weighted_of;
        for (std::size_t i = 0; i < corners.size(); ++i)
            weighted_of.at(i) = weighted(corners[i]);
        for (const std::uint32_t corner : corners) {
            const Vec3& own = face_[corner / 3];
            Vec3 sum;
            for (std::size_t i = 0; i < corners.size(); ++i)
                if (dot(own, face_[corners[i] / 3]) >= kCosCrease)
                    sum = sum + weighted_of.at(i);
            normals_[corner] = pack_normal(length_sq(sum) > 0 ? sum : own);
        }
    }

    /// Each face joins the first group whose first face is within the angle.
    void smooth_groups(std::span<const std::uint32_t> corners) {
        struct Group {
            Vec3 first, sum;
        };
        std::vector<Group> groups;
        std::vector<std::uint32_t> group_of;
        for (const std::uint32_t corner : corners) {
            const Vec3& own = face_[corner / 3];
            std::uint32_t at = 0;
            while (at < groups.size() && dot(groups[at].first, own) < kCosCrease)
                ++at;
            // A face without area is in no angle of any group.
            if (at == groups.size() && (groups.size() < kMostPairwise))
                groups.push_back({own, {}});
            at = std::min<std::uint32_t>(at, static_cast<std::uint32_t>(groups.size()) - 1);
            groups[at].sum = groups[at].sum + weighted(corner);
            group_of.push_back(at);
        }
        for (std::size_t i = 0; i < corners.size(); ++i)
            normals_[corners[i]] = pack_normal(groups[group_of[i]].sum);
    }

    const Mesh& mesh_;
    const std::vector<Vec3>& placed_;
    std::vector<Vec3> face_;
    std::vector<PackedNormal> normals_;
};

/// The vertices of a surface that stand for a mesh's positions, one for each normal.
class SplitVertices {
public:
    SplitVertices(std::size_t positions, std::uint32_t part, LevelSurface& to)
        : first_(positions, kNone), part_(part), to_(to) {}

    std::uint32_t find(std::uint32_t position, const Vec3& placed, const PackedNormal& normal) {
        std::uint32_t* link = &first_[position];
        while (*link != kNone) {
            if (to_.vertices[base_ + *link].normal == normal)
                return base_ + *link;
            link = &next_[*link];
        }
        const auto made = static_cast<std::uint32_t>(next_.size());
        *link = made;
        next_.push_back(kNone);
        to_.vertices.push_back({placed, normal, part_});
        return base_ + made;
    }

private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    std::vector<std::uint32_t> first_, next_;
    std::uint32_t part_;
    LevelSurface& to_;
    std::uint32_t base_ = static_cast<std::uint32_t>(to_.vertices.size());
};

} // namespace

void add_shaded(const Mesh& mesh, const Transform& frame_from_mesh, std::uint32_t part,
                LevelSurface& to) {
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    add_shaded(mesh, all, frame_from_mesh, part, to);
}

void add_shaded(const Mesh& mesh, std::span<const std::uint32_t> chosen,
                const Transform& frame_from_mesh, std::uint32_t part, LevelSurface& to) {
    std::vector<Vec3> placed;
    placed.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions)
        placed.push_back(apply(frame_from_mesh, p));
    const bool is_mirrored = is_mirroring(frame_from_mesh);
    const std::vector<std::uint32_t> position_of =
        first_equal_positions(std::span<const Vec3>(placed));
    const CornerNormals normals(mesh, placed, position_of, is_mirrored ? -1 : 1);
    SplitVertices split(placed.size(), part, to);
    for (const std::uint32_t i : chosen) {
        auto& triangle = to.triangles.emplace_back();
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t v = position_of[mesh.triangles[i].at(k)];
            triangle.at(k) = split.find(v, placed[v], normals(3 * i + k));
        }
        if (is_mirrored)
            std::swap(triangle[1], triangle[2]);
    }
}

} // namespace abut
