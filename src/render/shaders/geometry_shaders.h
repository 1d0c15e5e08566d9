#pragma once

namespace abut {

/// Draws a chunk.
///
/// Definitions: INSTANCED (placed by attributes), SECTION (cut by planes), GHOSTS (draws only ghosted
/// parts, how much each lets through), GROUND (draws the ground plane instead of a chunk).
///
/// The output of parts is two integers: the part's number + 1, with bit 31 for highlighted and bit
/// 30 for the inside of a part that a section lays open; and the normal as an octahedral map of
/// 16 + 16 bits.
extern const char* const kGeometryVertexShader;
extern const char* const kGeometryFragmentShader;

} // namespace abut
