#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

/// Procedural surfaces that deform: input for continuous collision detection, of the kind and size
/// of the benchmarks in [Curtis, Tamstorf, Manocha 2008]. scenes/README.md describes them.
namespace abut {

struct DeformingOptions {
    std::uint64_t triangles = 0; ///< met within 5 %; 0: the scene's own `triangles`
    std::uint64_t seed = 1;
};

/// Time from one frame to the next.
inline constexpr double kFrameSeconds = 1.0 / 60;

/// A sequence of frames, produced one at a time. It never ends: its action continues or comes to
/// rest.
class DeformingScene {
public:
    virtual ~DeformingScene() = default;
    /// The current frame, in metres, y up. Its positions are exact as floats.
    [[nodiscard]] virtual const Mesh& mesh() const = 0;
    /// Advances to the next frame.
    ///
    /// Cost        some 0.2 s on one core for 40,000 triangles of cloth; more where many layers
    ///             meet.
    virtual void step() = 0;
};

struct DeformingSceneInfo {
    std::string_view name;
    std::string_view description;
    std::uint64_t triangles = 0; ///< per frame, by default
    std::uint32_t frames = 0;    ///< number of frames that show the whole action
};

/// All scenes.
extern const std::array<DeformingSceneInfo, 6> kDeformingScenes;

/// Creates the scene of a name.
///
/// In/out      the same options give the same frames, whatever the number of threads.
/// Errors      Error{bad_argument} if there is no scene of that name, or if `triangles` is neither
///             0 nor in [1000, 10,000,000].
std::unique_ptr<DeformingScene> make_deforming_scene(std::string_view name,
                                                     const DeformingOptions& options = {});

} // namespace abut
