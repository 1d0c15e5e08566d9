#pragma once

namespace abut {

/// Draws quads around segments and dots, in pixels. What lies behind geometry is fainter.
extern const char* const kMarkVertexShader;
extern const char* const kMarkFragmentShader;

} // namespace abut
