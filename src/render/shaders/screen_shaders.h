#pragma once

namespace abut {

/// A triangle that covers the picture.
extern const char* const kScreenVertexShader;
/// Makes the colours of the picture from the buffer of parts and depth.
///
/// Definitions: EDGES, OCCLUSION (reads a texture of it), GHOSTS (reads what they let through),
/// HIGHLIGHTS, STILL (compares with four neighbours rather than two, for several samples a pixel).
extern const char* const kShadeFragmentShader;
/// How much of the sky each pixel sees, from the depth around it. Writes occlusion and depth.
extern const char* const kOcclusionFragmentShader;
/// The farthest distance along the viewing direction in each tile of 16 x 16 samples.
extern const char* const kFarthestFragmentShader;
/// Removes the noise of the above: the mean of 4 x 4 pixels at about the same depth.
extern const char* const kSmoothFragmentShader;

} // namespace abut
