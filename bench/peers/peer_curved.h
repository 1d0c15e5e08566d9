#pragma once

#include <abut/curved_shapes.h>
#include <abut/types.h>
#include <abut/world.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace abut::bench {

/// Shapes whose axis is z, as peers want them, around the middle of their boxes.
using CurvedShapeOfPeer = std::variant<Cylinder, Cone, Ellipsoid>;

/// A peer that answers queries on pairs of curved shapes.
class CurvedPeer {
public:
    virtual ~CurvedPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Places the shapes. This is not measured.
    virtual void set_poses(const std::vector<Pose>& poses) = 0;
    /// Whether two shapes, given by their indices, meet.
    virtual bool collide(std::size_t a, std::size_t b) = 0;
    /// Their distance, or minus their depth.
    virtual double signed_distance(std::size_t a, std::size_t b) = 0;

protected:
    CurvedPeer() = default;
    CurvedPeer(const CurvedPeer&) = default;
    CurvedPeer& operator=(const CurvedPeer&) = default;
};

/// FCL with its default solver, libccd. Null if this program is built without FCL.
std::unique_ptr<CurvedPeer> make_fcl_curved(const std::vector<CurvedShapeOfPeer>& shapes);

} // namespace abut::bench
