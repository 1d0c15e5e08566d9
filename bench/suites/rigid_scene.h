#pragma once

#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::bench {

/// The relative position of two models of diagonal 1.
enum class Regime : std::uint8_t {
    deep,      ///< middles at most 0.2 apart
    graze_in,  ///< at most 0.01 further in than their first touch
    graze_out, ///< at most 0.01 further out than their first touch
    separated, ///< 0.05 to 0.5 further out
    path,      ///< paths of 50 steps of 1 degree and 0.005, starting 0.1 further out; no contact
};
inline constexpr std::array kRegimes{Regime::deep, Regime::graze_in, Regime::graze_out,
                                     Regime::separated, Regime::path};
const char* to_string(Regime regime);

inline constexpr std::size_t kPathSteps = 50;

struct PosedPair {
    Transform a, b;
};

struct RigidScene {
    std::string name;
    Mesh a, b; ///< middle of the box at the origin, diagonal 1
    std::array<std::vector<PosedPair>, kRegimes.size()> poses;

    [[nodiscard]] const std::vector<PosedPair>& of(Regime regime) const {
        return poses[static_cast<std::size_t>(regime)];
    }
};

/// Creates the poses. The same meshes and seed give the same poses on every machine, up to rounding
/// of the distance at which they first touch.
RigidScene make_rigid_scene(std::string name, Mesh a, Mesh b, std::size_t poses,
                            std::uint64_t seed);

} // namespace abut::bench
