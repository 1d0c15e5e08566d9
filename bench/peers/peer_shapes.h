#pragma once

#include <abut/mesh.h>
#include <abut/shapes.h>

#include <memory>

namespace abut::bench {

/// A peer that answers ray queries on one mesh.
class RayPeer {
public:
    virtual ~RayPeer() = default;
    /// The first t >= 0; infinite if the ray misses.
    [[nodiscard]] virtual double first_hit(const Ray& ray) const = 0;

protected:
    RayPeer() = default;
    RayPeer(const RayPeer&) = default;
    RayPeer& operator=(const RayPeer&) = default;
};

class NearestPeer {
public:
    virtual ~NearestPeer() = default;
    [[nodiscard]] virtual double distance(const Vec3& point) const = 0;

protected:
    NearestPeer() = default;
    NearestPeer(const NearestPeer&) = default;
    NearestPeer& operator=(const NearestPeer&) = default;
};

/// Embree in single precision, in its robust mode. Null if this program is built without Embree.
std::unique_ptr<RayPeer> make_embree_rays(const Mesh& mesh);

/// CGAL's AABB tree in double precision, with its search tree for closest points. Null if this
/// program is built without CGAL.
std::unique_ptr<NearestPeer> make_cgal_nearest(const Mesh& mesh);

} // namespace abut::bench
