#pragma once

#include <cstdint>
#include <hwy/targets.h>
#include <string>
#include <vector>

namespace abut::test {

/// Runs `body(name)` with every SIMD target of this machine, the best first, and restores the
/// choice. A target is chosen by hiding all better ones, which have lower bits.
template <typename Body>
void for_each_simd_target(const Body& body) {
    const std::int64_t supported = hwy::SupportedTargets();
    for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest);
        body(std::string(hwy::TargetName(rest & -rest)));
    }
    hwy::SetSupportedTargetsForTest(0);
}

} // namespace abut::test
