#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// A body of a bench of contacts.
struct ContactBody {
    enum class Kind { box, capsule, hull, ball, mesh } kind = Kind::box;
    Vec3 half{};                ///< box: half sides. Capsule: z is half of the axis, along z
    double radius = 0;          ///< of a capsule or a ball
    std::vector<Vec3> points{}; ///< of a hull
    Mesh mesh{};
    bool is_static = false;
};

/// The margin of a peer that has its own.
inline constexpr double kOwnMargin = -1;

/// A peer that keeps bodies and their contacts from step to step.
class ManifoldPeer {
public:
    virtual ~ManifoldPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Moves all bodies and finds their contacts. Returns the number of contact points.
    virtual std::size_t step(const std::vector<Pose>& poses) = 0;

protected:
    ManifoldPeer() = default;
    ManifoldPeer(const ManifoldPeer&) = default;
    ManifoldPeer& operator=(const ManifoldPeer&) = default;
};

/// Bullet's collision world in single precision, as packaged by Debian. Null if this program is built
/// without Bullet.
///
/// In          margin: the distance up to which it keeps points; that of its shapes stays.
std::unique_ptr<ManifoldPeer> make_bullet_manifolds(const std::vector<ContactBody>& bodies,
                                                    double margin = kOwnMargin);

} // namespace abut::bench
