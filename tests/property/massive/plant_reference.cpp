#include "tests/property/massive/plant_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace abut::reference {
namespace {

using Triangle = std::array<Vec3, 3>;

double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

double point_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    return length(p - (a + d * t));
}

/// The minimum is at an end of one segment, or where the two lines are closest.
double segment_segment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    double best = std::min({point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b),
                            point_segment(d, a, b)});
    const Vec3 u = b - a, v = d - c, w = a - c;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double det = uu * vv - uv * uv;
    if (det > 0) {
        const double s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            best = std::min(best, length(a + u * s - (c + v * t)));
        }
    }
    return best;
}

/// Distance to the interior of a triangle; infinite if the foot of the perpendicular lies outside.
double point_face(const Vec3& p, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    for (std::size_t k = 0; k < 3; ++k) {
        if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) < 0) {
            return std::numeric_limits<double>::infinity();
        }
    }
    return std::abs(dot(p - t[0], n)) / length(n);
}

bool pierces(const Vec3& a, const Vec3& b, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double da = dot(a - t[0], n), db = dot(b - t[0], n);
    if ((da > 0) == (db > 0) || da == db) {
        return false;
    }
    return point_face(a + (b - a) * (da / (da - db)), t) < std::numeric_limits<double>::infinity();
}

double triangle_triangle(const Triangle& a, const Triangle& b) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) {
            return 0;
        }
        best = std::min({best, point_face(a[i], b), point_face(b[i], a)});
        for (std::size_t k = 0; k < 3; ++k) {
            best = std::min(best, segment_segment(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
        }
    }
    return best;
}

Box3 box_of(const std::vector<Triangle>& triangles) {
    Box3 box;
    for (const Triangle& t : triangles) {
        for (const Vec3& p : t) {
            box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                         std::min(box.lower.z, p.z)};
            box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                         std::max(box.upper.z, p.z)};
        }
    }
    return box;
}

bool within(const Box3& a, const Box3& b, double limit) {
    return a.lower.x <= b.upper.x + limit && b.lower.x <= a.upper.x + limit &&
           a.lower.y <= b.upper.y + limit && b.lower.y <= a.upper.y + limit &&
           a.lower.z <= b.upper.z + limit && b.lower.z <= a.upper.z + limit;
}

/// Whether a point is inside, by the winding number from solid angles.
bool inside(const Vec3& p, const std::vector<Triangle>& solid) {
    double angle = 0;
    for (const Triangle& t : solid) {
        const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        angle += 2 * std::atan2(dot(a, cross(b, c)),
                                la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return angle > 2 * std::numbers::pi;
}

double distance(const std::vector<Triangle>& a, const std::vector<Triangle>& b, const Box3& box_b,
                double limit) {
    double best = std::numeric_limits<double>::infinity();
    for (const Triangle& ta : a) {
        const Box3 box_ta = box_of({ta});
        if (!within(box_ta, box_b, limit)) {
            continue;
        }
        for (const Triangle& tb : b) {
            if (within(box_ta, box_of({tb}), limit)) {
                best = std::min(best, triangle_triangle(ta, tb));
            }
        }
    }
    return best;
}

} // namespace

std::map<std::pair<std::uint32_t, std::uint32_t>, Nearness>
near_pairs(const Scene& scene, const std::vector<bool>& closed, double limit,
           std::uint64_t& examined) {
    std::vector<std::vector<Triangle>> world;
    std::vector<Box3> box;
    for (const Part& part : scene.parts) {
        const auto& m = part.world_from_mesh.m;
        std::vector<Triangle>& triangles = world.emplace_back();
        for (const auto& t : scene.meshes[part.mesh].triangles) {
            Triangle& moved = triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& p = scene.meshes[part.mesh].positions[t[k]];
                moved[k] = {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
                            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
                            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
            }
        }
        box.push_back(box_of(triangles));
    }
    std::vector<std::uint32_t> order(scene.parts.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](auto i, auto k) { return box[i].lower.x < box[k].lower.x; });
    std::map<std::pair<std::uint32_t, std::uint32_t>, Nearness> result;
    examined = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t k = i + 1; k < order.size(); ++k) {
            const auto [a, b] = std::minmax(order[i], order[k]);
            if (box[order[k]].lower.x > box[order[i]].upper.x + limit) {
                break;
            }
            if (!within(box[a], box[b], limit)) {
                continue;
            }
            ++examined;
            const double d = distance(world[a], world[b], box[b], limit);
            const bool a_in_b =
                closed[scene.parts[b].mesh] && inside(world[a].front().front(), world[b]);
            const bool b_in_a =
                closed[scene.parts[a].mesh] && inside(world[b].front().front(), world[a]);
            const bool contained = d > 0 && (a_in_b || b_in_a);
            if (d <= limit || contained) {
                // Beyond the limit, pairs of triangles were skipped: measure again without a limit.
                const double all = std::numeric_limits<double>::infinity();
                result[{a, b}] = {d <= limit ? d : distance(world[a], world[b], box[b], all),
                                  contained};
            }
        }
    }
    return result;
}

} // namespace abut::reference
