#pragma once

#include <abut/mesh.h>
#include <abut/motion.h>

#include <memory>
#include <optional>

namespace abut::bench {

/// FCL's continuous collision of two meshes.
class FclImpact {
public:
    virtual ~FclImpact() = default;

    /// The reported time of contact, if there is one. Each body moves from its first pose to its
    /// second.
    [[nodiscard]] virtual std::optional<double> time_of_impact(const Pose& from_a, const Pose& to_a,
                                                               const Pose& from_b,
                                                               const Pose& to_b) const = 0;

protected:
    FclImpact() = default;
    FclImpact(const FclImpact&) = default;
    FclImpact& operator=(const FclImpact&) = default;
};

/// Conservative advancement on OBBRSS, to a time error of 1e-4. Of FCL's solvers, only this one
/// handles rotation without sampling. Null if this program is built without FCL.
std::unique_ptr<FclImpact> make_fcl_impact(const Mesh& a, const Mesh& b);

} // namespace abut::bench
