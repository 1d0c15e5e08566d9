#pragma once

#include "suites/clash_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// FCL on the instances of one part.
class FclInstances {
public:
    virtual ~FclInstances() = default;

    /// Whether two instances are in contact. Stops at the first contact.
    [[nodiscard]] virtual bool collide(std::uint32_t a, std::uint32_t b) const = 0;
    /// The distance if it is below `upper_bound`, else that bound. The search starts with the
    /// bound.
    [[nodiscard]] virtual double distance(std::uint32_t a, std::uint32_t b,
                                          double upper_bound) const = 0;
    /// "FCL 0.7.0, RSS": the volume that was fastest for the query on a sample.
    [[nodiscard]] virtual std::string collide_name() const = 0;
    [[nodiscard]] virtual std::string distance_name() const = 0;
    /// Microseconds per pair on the sample for each volume, one line for each query.
    [[nodiscard]] virtual std::vector<std::string> choice() const = 0;

protected:
    FclInstances() = default;
    FclInstances(const FclInstances&) = default;
    FclInstances& operator=(const FclInstances&) = default;
};

/// Builds FCL's hierarchy with each of its volumes, and keeps the fastest for each query on a
/// sample of the candidates. Null if this program is built without FCL.
std::unique_ptr<FclInstances> make_fcl_instances(const ClashScene& scene, double clearance);

} // namespace abut::bench
