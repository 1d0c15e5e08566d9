#include "rigid/penetration/edge_sectors.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>

namespace abut {

void EdgeSectors::add(const Ray& ray) {
    if (!collinear(e0_, e1_, ray.apex))
        rays_.push_back(ray);
}

/// The angle from the first ray, counter-clockwise: 0: none; 1: less than half a turn; 2: half a
/// turn; 3: more.
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
    const Ray first = rays_.front(); // the order is relative to this ray, so it must stay first
    std::stable_sort(rays_.begin() + 1, rays_.end(),
                     [&](const Ray& r, const Ray& s) { return before(r, s); });
    rays_.front() = first;
    angle_.assign(rays_.size(), 0);
    for (std::size_t i = 1; i < rays_.size(); ++i)
        angle_[i] = angle_[i - 1] + (before(rays_[i - 1], rays_[i]) ? 1 : 0);
}

/// Two coplanar faces on one ray with the same inner side have both interiors there.
bool EdgeSectors::interiors_share_a_face() const {
    for (std::size_t i = 0; i < rays_.size(); ++i)
        for (std::size_t j = i + 1; j < rays_.size() && angle_[j] == angle_[i]; ++j)
            if (rays_[i].of_a != rays_[j].of_a && rays_[i].outward != 0 &&
                rays_[i].outward == rays_[j].outward)
                return true;
    return false;
}

/// Returns whether a face of one model lies strictly between two faces of the other, on their inner
/// side.
bool EdgeSectors::enters(bool of_a) const {
    std::vector<std::size_t> walls;
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (rays_[i].of_a != of_a)
            walls.push_back(i);
    // Only one wedge of the solid with consistently oriented faces tells on which side the inside
    // is.
    if (walls.size() != 2 || rays_[walls[0]].outward == 0 ||
        rays_[walls[0]].outward != -rays_[walls[1]].outward || angle_[walls[0]] == angle_[walls[1]])
        return false;
    // The inside lies counter-clockwise of a wall if that is not the wall's outer side.
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
