#include "render/shaders/mark_shaders.h"

namespace abut {

const char* const kMarkVertexShader = R"glsl(
uniform vec2 u_size;
layout(location = 0) in vec3 a_at;     // pixels from the lower left corner, and depth
layout(location = 1) in vec3 a_across; // distance from the middle in pixels, along, half width
layout(location = 2) in vec3 a_colour;
out vec3 v_across;
out vec3 v_colour;
out float v_inverse_depth;

void main() {
    v_across = a_across;
    v_colour = a_colour;
    v_inverse_depth = 1.0 / a_at.z;
    gl_Position = vec4(a_at.xy / u_size * 2.0 - 1.0, 0.0, 1.0);
}
)glsl";

const char* const kMarkFragmentShader = R"glsl(
uniform sampler2D u_depth;
uniform vec3 u_depth_to_w;
uniform int u_samples;
in vec3 v_across;
in vec3 v_colour;
in float v_inverse_depth;
out vec4 o_colour;

void main() {
    float off = length(v_across.xy) - v_across.z;
    float cover = clamp(0.5 - off, 0.0, 1.0);
    float rim = clamp(1.5 + off, 0.0, 1.0);
    float depth = texelFetch(u_depth, ivec2(gl_FragCoord.xy) * u_samples, 0).r;
    float w = u_depth_to_w.x / (u_depth_to_w.y + u_depth_to_w.z * depth);
    float seen = 1.0 / v_inverse_depth <= w * 1.002 ? 1.0 : 0.45;
    o_colour = vec4(mix(v_colour, v_colour * 0.35, rim * 0.8), cover * seen);
}
)glsl";

} // namespace abut
