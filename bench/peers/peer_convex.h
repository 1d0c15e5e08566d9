#pragma once

#include <abut/convex.h>

#include "suites/rigid_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// A peer that answers queries on one pair of convex bodies in many poses.
class ConvexPeer {
public:
    virtual ~ConvexPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Converts the poses. This is not measured.
    virtual void set_poses(const std::vector<PosedPair>& poses) = 0;
    /// The distance in a pose, given by its index; 0 if the bodies meet.
    virtual double distance(std::size_t pose) = 0;
    /// The depth in a pose in which the bodies meet.
    virtual double penetration(std::size_t pose) = 0;

protected:
    ConvexPeer() = default;
    ConvexPeer(const ConvexPeer&) = default;
    ConvexPeer& operator=(const ConvexPeer&) = default;
};

/// FCL's Convex with its default solver, libccd. Null if this program is built without FCL.
std::unique_ptr<ConvexPeer> make_fcl_convex(const Convex& a, const Convex& b);

/// Bullet's GJK and EPA on btConvexHullShape without margins, in single precision as packaged by
/// Debian. Null if this program is built without Bullet.
std::unique_ptr<ConvexPeer> make_bullet_convex(const Convex& a, const Convex& b);

} // namespace abut::bench
