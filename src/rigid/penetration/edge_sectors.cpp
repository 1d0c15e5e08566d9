#include "rigid/penetration/edge_sectors.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>

namespace abut {

void EdgeSectors::add(const Ray& ray) {
    if (!collinear(e0_, e1_, ray.apex))
        rays_.push_back(ray);
}

/// 0: with the first ray; 1: less than half a turn counter-clockwise from it; 2: opposite; 3:
/// beyond.
int EdgeSectors::half_turn(const Vec3& apex) const {
    const Vec3& first = rays_.front().apex;
    const int side = orient3d(e0_, e1_, first, apex);
    if (side != 0)
        return side > 0 ? 1 : 3;
    const int axis = projection_axis({e0_, e1_, first});
    return orient2d(e0_, e1_, first, axis) == orient2d(e0_, e1_, apex, axis) ? 0 : 2;
}

bool EdgeSectors::before(const Ray& r, const Ray& s) const {
    const int turn_r = half_turn(r.apex), turn_s = half_turn(s.apex);
    if (turn_r != turn_s)
        return turn_r < turn_s;
    return (turn_r == 1 || turn_r == 3) && orient3d(e0_, e1_, r.apex, s.apex) > 0;
}

void EdgeSectors::sort() {
    const Ray first = rays_.front(); // the order is relative to it: it stays first
    std::stable_sort(rays_.begin() + 1, rays_.end(),
                     [&](const Ray& r, const Ray& s) { return before(r, s); });
    rays_.front() = first;
    angle_.assign(rays_.size(), 0);
    for (std::size_t i = 1; i < rays_.size(); ++i)
        angle_[i] = angle_[i - 1] + (before(rays_[i - 1], rays_[i]) ? 1 : 0);
}

/// Coplanar faces on one ray whose inner sides agree: both interiors lie there.
bool EdgeSectors::interiors_share_a_face() const {
    for (std::size_t i = 0; i < rays_.size(); ++i)
        for (std::size_t j = i + 1; j < rays_.size() && angle_[j] == angle_[i]; ++j)
            if (rays_[i].of_a != rays_[j].of_a && rays_[i].outward != 0 &&
                rays_[i].outward == rays_[j].outward)
                return true;
    return false;
}

/// A face of one model strictly between the two faces of the other, on their inner side.
bool EdgeSectors::enters(bool of_a) const {
    std::vector<std::size_t> walls;
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (rays_[i].of_a != of_a)
            walls.push_back(i);
    // Exactly one wedge of the solid, its faces turned consistently: else the sector's side is not
    // known.
    if (walls.size() != 2 || rays_[walls[0]].outward == 0 ||
        rays_[walls[0]].outward != -rays_[walls[1]].outward || angle_[walls[0]] == angle_[walls[1]])
        return false;
    // Counter-clockwise of a wall lies the inside if that side is not its outer one.
    const bool inside_between = rays_[walls[0]].outward < 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (rays_[i].of_a != of_a || angle_[i] == angle_[walls[0]] || angle_[i] == angle_[walls[1]])
            continue;
        const bool between = angle_[i] > angle_[walls[0]] && angle_[i] < angle_[walls[1]];
        if (between == inside_between)
            return true;
    }
    return false;
}

bool EdgeSectors::interiors_overlap() {
    if (rays_.empty())
        return false;
    sort();
    return interiors_share_a_face() || enters(true) || enters(false);
}

} // namespace abut
