#pragma once

#include <abut/mesh.h>
#include <abut/motion.h>

#include <memory>
#include <optional>

namespace abut::bench {

/// FCL's continuous collision of two meshes. Without FCL nothing can be made.
class FclImpact {
public:
    virtual ~FclImpact() = default;

    /// The time of contact that it reports, each body moving from its first pose to its second.
    [[nodiscard]] virtual std::optional<double> time_of_impact(const Pose& from_a, const Pose& to_a,
                                                               const Pose& from_b,
                                                               const Pose& to_b) const = 0;

protected:
    FclImpact() = default;
    FclImpact(const FclImpact&) = default;
    FclImpact& operator=(const FclImpact&) = default;
};

/// Conservative advancement, the one solver of FCL's that is not sampled and turns too, on OBBRSS,
/// to a time error of 1e-4. Null where this program is built without FCL.
std::unique_ptr<FclImpact> make_fcl_impact(const Mesh& a, const Mesh& b);

} // namespace abut::bench
