#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

/// Procedural surfaces that deform: input of continuous collision detection, of the kind and size of
/// the benchmarks in [Curtis, Tamstorf, Manocha 2008]. scenes/README.md says what they show.
namespace abut {

struct DeformingOptions {
    std::uint64_t triangles = 0; ///< hit within 5 %; 0: as many as the scene's `triangles`
    std::uint64_t seed = 1;
};

/// From one frame to the next.
inline constexpr double kFrameSeconds = 1.0 / 60;

/// One sequence of frames, made one at a time. It has no end: its action goes on, or
/// comes to rest.
class DeformingScene {
public:
    virtual ~DeformingScene() = default;
    /// The frame as it is now. Metres, y up; positions are exact as floats.
    [[nodiscard]] virtual const Mesh& mesh() const = 0;
    /// To the next frame.
    ///
    /// Cost        of 40,000 triangles of cloth, some 0.2 s on one core; more where many layers meet.
    virtual void step() = 0;
};

struct DeformingSceneInfo {
    std::string_view name;
    std::string_view description;
    std::uint64_t triangles = 0; ///< of a frame, unless asked otherwise
    std::uint32_t frames = 0;    ///< that show all of it
};

/// All that there are.
extern const std::array<DeformingSceneInfo, 6> kDeformingScenes;

/// In/out      the same frames for the same options, whatever the number of threads.
/// Errors      Error{bad_argument} if there is no scene of that name, or `triangles` is neither 0 nor in
///             [1000, 10,000,000].
std::unique_ptr<DeformingScene> make_deforming_scene(std::string_view name,
                                                     const DeformingOptions& options = {});

} // namespace abut
