#pragma once

#include <abut/convex.h>

#include "rigid_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// A peer that answers for one pair of convex bodies at many poses.
class ConvexPeer {
public:
    virtual ~ConvexPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Converts them, which is not measured.
    virtual void set_poses(const std::vector<PosedPair>& poses) = 0;
    /// At a pose by its index; 0 if they meet.
    virtual double distance(std::size_t pose) = 0;
    /// Of bodies that meet.
    virtual double penetration(std::size_t pose) = 0;

protected:
    ConvexPeer() = default;
    ConvexPeer(const ConvexPeer&) = default;
    ConvexPeer& operator=(const ConvexPeer&) = default;
};

/// FCL's Convex with its default solver, libccd. Null where this program is built without it.
std::unique_ptr<ConvexPeer> make_fcl_convex(const Convex& a, const Convex& b);

/// Bullet's GJK and EPA on btConvexHullShape without margins, in single precision as Debian packages
/// it. Null where this program is built without it.
std::unique_ptr<ConvexPeer> make_bullet_convex(const Convex& a, const Convex& b);

} // namespace abut::bench
