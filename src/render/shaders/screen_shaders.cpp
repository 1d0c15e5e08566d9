#include "render/shaders/screen_shaders.h"

namespace abut {

const char* const kScreenVertexShader = R"glsl(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)glsl";

const char* const kShadeFragmentShader = R"glsl(
uniform usampler2D u_parts;
uniform sampler2D u_depth, u_states, u_occlusion, u_ghosts;
uniform vec3 u_depth_to_w;           // w = x / (y + z * depth)
uniform vec3 u_right, u_up, u_forward; // right and up: scaled to the border of the picture
uniform vec3 u_sky, u_light;         // unit vectors: up, and to the light
uniform vec2 u_size;
uniform float u_pixel;               // length of a sample at depth 1
uniform float u_detail;
uniform float u_samples;            // along a side of a pixel
uniform vec3 u_low, u_high;
uniform vec3 u_eye;                  // from the middle of the ground
uniform vec3 u_ground_x;             // an axis of its grid
uniform float u_ground_reach, u_grid;
uniform int u_occlusion_scale;
#ifdef DISTANCES
uniform sampler2D u_distances; // in pixels, as fractions of the reach
#endif
out vec4 o_colour;

const uint kGround = 0x3fffffffu;

#ifdef QUICK
vec3 decode_long(uint bits) {
    return vec3(ivec3(int(bits & 1023u), int((bits >> 10) & 1023u), int(bits >> 20))) - 512.0;
}
vec3 decode(uint bits) {
    vec3 n = decode_long(bits);
    return n * inversesqrt(dot(n, n) + 1e-9);
}
#else
vec3 decode(uint bits) {
    vec2 e = (vec2(bits & 0xffffu, bits >> 16) - 32767.0) / 32766.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}
#endif

float w_of(float depth) { return u_depth_to_w.x / (u_depth_to_w.y + u_depth_to_w.z * depth); }
vec3 ray_of(vec2 at) {
    vec2 s = at / u_size * 2.0 - 1.0;
    return u_forward + s.x * u_right + s.y * u_up;
}

#ifdef QUICK
// How strong an edge is between this sample and a neighbour, in [0, 1]. Software executes all
// branches, so there are none. Silhouettes of a part before itself are not found.
float edge(ivec2 here, ivec2 step, uvec2 part, vec3 n, vec3 at, float w, float fade) {
    uvec2 other = texelFetch(u_parts, min(here + step, ivec2(u_size) - 1), 0).xy;
    uint a = (part.x + 1u) & 0x3fffffffu, b = (other.x + 1u) & 0x3fffffffu; // ground 0, sky 1
    vec3 m = decode_long(other.y);
    float along = dot(n, m);
    float crease = clamp((0.81 * dot(m, m) - along * along) * (1.0 / 60000.0), 0.0, 1.0);
    float border = min(a, b) > 1u ? fade : max(a, b) > 1u ? max(fade, 0.5) : 0.0;
    return a == b ? 0.7 * fade * fade * crease : border;
}
#else
// How strong an edge is between this sample and a neighbour, in [0, 1].
float edge(ivec2 here, ivec2 step, uvec2 part, vec3 n, vec3 at, float w, float fade) {
    ivec2 there = clamp(here + step, ivec2(0), ivec2(u_size) - 1);
    uvec2 other = texelFetch(u_parts, there, 0).xy;
    if (other == part)
        return 0.0;
    uint a = part.x & 0x3fffffffu, b = other.x & 0x3fffffffu;
    if (a == 0u || b == 0u)
        return (a == kGround || b == kGround) ? 0.0 : max(fade, 0.5);
    if (a != b)
        return (a == kGround || b == kGround) ? max(fade, 0.5) : fade;
    float bend = dot(n, decode(other.y));
    if ((part.x ^ other.x) != 0u)
        return fade;
    if ((part.x & 0x40000000u) != 0u)
        return 0.0; // what is cut is flat
    float turned = 1.0 - smoothstep(0.76, 0.90, abs(bend));
    if (turned > 0.0)
        return 0.7 * turned * fade * fade;
    // The same part again at another depth: a silhouette of the part before itself.
    float w_there = w_of(texelFetch(u_depth, there, 0).r);
    float off = abs(dot(n, ray_of(vec2(there) + 0.5) * w_there - at));
    return off > 4.0 * u_pixel * max(w, w_there) ? fade : 0.0;
}
#endif

#ifdef DISTANCES
// As abut::distance_colour.
vec3 distance_colour(float part) {
    const vec3 ramp[5] = vec3[5](vec3(214, 38, 30), vec3(242, 140, 38), vec3(242, 222, 77),
                                 vec3(115, 199, 102), vec3(89, 153, 217));
    float at = clamp(part, 0.0, 1.0) * 4.0;
    int i = min(int(at), 3);
    return mix(ramp[i], ramp[i + 1], at - float(i)) / 255.0;
}
#endif

vec3 background(vec3 ray) {
    float height = dot(normalize(ray), u_sky) * 0.5 + 0.5;
    return mix(u_low, u_high, smoothstep(0.42, 0.85, height));
}

#ifdef GROUND
// Colour of the ground, with a grid that fades.
vec3 ground(vec3 ray, float w, vec3 behind) {
    vec3 at = ray * w + u_eye;
    vec2 place = vec2(dot(at, u_ground_x), dot(at, cross(u_sky, u_ground_x)));
    float slope = abs(dot(normalize(ray), u_sky)) + 1e-4;
    vec2 wide = vec2(u_pixel * w / slope);
    vec2 cell = abs(fract(place / u_grid - 0.5) - 0.5) * u_grid;
    vec2 line = 1.0 - smoothstep(vec2(0.0), wide * 1.2, cell);
    float grid = max(line.x, line.y) * clamp(u_grid / (wide.x * 12.0) - 0.3, 0.0, 1.0);
    vec3 colour = mix(vec3(0.795, 0.805, 0.81), vec3(0.62, 0.64, 0.66), 0.55 * grid);
    float far = length(place) / u_ground_reach;
    return mix(colour, behind, smoothstep(0.25, 1.0, far));
}
#endif

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    uvec2 part = texelFetch(u_parts, here, 0).xy;
    vec3 ray = ray_of(gl_FragCoord.xy);
    uint number = part.x & 0x3fffffffu;
    float w = 0.0, fade = 1.0, open = 1.0;
    vec3 n = vec3(0.0), at = vec3(0.0), colour;
    if (number != 0u) {
        w = w_of(texelFetch(u_depth, here, 0).r);
        at = ray * w;
        n = decode(part.y);
        fade = min(1.0, 0.1 * u_detail / (u_pixel * w));
    }
#ifdef OCCLUSION
    if (number != 0u)
        open = texelFetch(u_occlusion, here / u_occlusion_scale, 0).r;
#endif
    if (number == 0u) {
        colour = background(ray);
#ifdef GROUND
    } else if (number == kGround) {
        colour = ground(ray, w, background(ray)) * mix(0.35, 1.0, open);
#endif
    } else {
        uint state = number - 1u;
        vec3 own = texelFetch(u_states, ivec2(int(state & 4095u), int(state >> 12)), 0).rgb;
#ifdef DISTANCES
        float far = texelFetch(u_distances, here / u_occlusion_scale, 0).r;
        if (far < 1.0)
            own = distance_colour(far);
#endif
        vec3 facing = dot(n, ray) > 0.0 ? -n : n;
        float sky = dot(facing, u_sky) * 0.5 + 0.5;
        float lit = max(dot(facing, u_light), 0.0);
        vec3 light = mix(vec3(0.33, 0.31, 0.30), vec3(0.60, 0.63, 0.68), sky) * open +
                     vec3(0.52, 0.50, 0.46) * lit * mix(1.0, open, 0.5);
        colour = own * sqrt(0.84 * light);
#ifdef SECTION
        if ((part.x & 0x40000000u) != 0u) {
            // The inside of a solid that is cut: flat, and hatched as in a drawing.
            float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * u_samples)) - 0.5);
            colour = mix(own, vec3(1.0), 0.35) * (stripe < 0.07 ? 0.72 : 0.97) * mix(0.85, 1.0, open);
            n = normalize(ray);
        }
#endif
    }
#ifdef EDGES
    float line = max(edge(here, ivec2(1, 0), part, n, at, w, fade),
                     edge(here, ivec2(0, 1), part, n, at, w, fade));
#ifdef STILL
    line = max(line, max(edge(here, ivec2(-1, 0), part, n, at, w, fade),
                         edge(here, ivec2(0, -1), part, n, at, w, fade)));
#endif
    if (number != 0u && number != kGround)
        colour *= 1.0 - 0.62 * line;
    else
        colour = mix(colour, vec3(0.16, 0.17, 0.19), 0.55 * line);
#endif
#ifdef GHOSTS
    float hidden = min(1.0 - texelFetch(u_ghosts, here, 0).r, 0.62);
    colour = mix(colour, vec3(0.60, 0.66, 0.72), hidden);
#endif
#ifdef HIGHLIGHTS
    const ivec2 around[8] = ivec2[8](ivec2(2, 0), ivec2(-2, 0), ivec2(0, 2), ivec2(0, -2),
                                     ivec2(2, 2), ivec2(-2, 2), ivec2(2, -2), ivec2(-2, -2));
#ifdef QUICK
    const int count = 4;
#else
    const int count = 8;
#endif
    uint own_bit = part.x >> 31, any = 0u;
    for (int i = 0; i < count; ++i)
        any |= texelFetch(u_parts, clamp(here + around[i], ivec2(0), ivec2(u_size) - 1), 0).x >> 31;
    if (own_bit == 0u && any != 0u)
        colour = vec3(1.0, 0.62, 0.05);
#endif
    o_colour = vec4(colour, 1.0);
}
)glsl";

const char* const kOcclusionFragmentShader = R"glsl(
uniform usampler2D u_parts;
uniform sampler2D u_depth;
uniform vec3 u_depth_to_w;
uniform vec3 u_right, u_up, u_forward;
uniform vec2 u_size;       // of the buffers that are read
uniform float u_pixel, u_reach;
uniform int u_scale;       // samples of the buffers along a side of a pixel here
layout(location = 0) out vec4 o_seen;

vec3 decode(uint bits) {
    vec2 e = (vec2(bits & 0xffffu, bits >> 16) - 32767.0) / 32766.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}
float w_of(float depth) { return u_depth_to_w.x / (u_depth_to_w.y + u_depth_to_w.z * depth); }
vec3 place(ivec2 at) {
    vec2 s = (vec2(at) + 0.5) / u_size * 2.0 - 1.0;
    return (u_forward + s.x * u_right + s.y * u_up) * w_of(texelFetch(u_depth, at, 0).r);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy) * u_scale;
    uvec2 part = texelFetch(u_parts, here, 0).xy;
    if ((part.x & 0x3fffffffu) == 0u) {
        o_seen = vec4(1.0, 0.0, 0.0, 0.0);
        return;
    }
    vec3 at = place(here), n = decode(part.y);
    float w = dot(at, u_forward);
    if (dot(n, at) > 0.0)
        n = -n;
    float pixels = clamp(u_reach / (u_pixel * w), 6.0 * float(u_scale), 0.09 * u_size.y);
    float reach = pixels * u_pixel * w;
    // A pattern of 4 x 4 directions, which the smoothing averages.
    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
    float turn = float((cell.x * 5 + cell.y * 7 + (cell.x * cell.y) * 3) & 15) * 0.3926991;
    float closed = 0.0;
    for (int i = 0; i < 14; ++i) {
        float far = (float(i) + 0.5) / 14.0, angle = turn + float(i) * 2.3999632;
        ivec2 there = here + ivec2(vec2(cos(angle), sin(angle)) * (far * pixels));
        if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, ivec2(u_size))))
            continue;
        if ((texelFetch(u_parts, there, 0).x & 0x3fffffffu) == 0u)
            continue;
        vec3 v = place(there) - at;
        float d2 = dot(v, v);
        float near = max(0.0, 1.0 - d2 / (reach * reach));
        closed += max(0.0, dot(v, n) - 0.02 * reach) * inversesqrt(d2 + 1e-12) * near;
    }
    o_seen = vec4(clamp(1.0 - closed * (2.1 / 14.0), 0.0, 1.0), w, 0.0, 0.0);
}
)glsl";

const char* const kSmoothFragmentShader = R"glsl(
uniform sampler2D u_noisy;
layout(location = 0) out vec4 o_seen;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), size = textureSize(u_noisy, 0);
    vec2 own = texelFetch(u_noisy, here, 0).rg;
    float sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            vec2 other = texelFetch(u_noisy, clamp(here + ivec2(x, y), ivec2(0), size - 1), 0).rg;
            float weight = abs(other.y - own.y) < 0.02 * own.y ? 1.0 : 0.001;
            sum += weight * other.x;
            weights += weight;
        }
    o_seen = vec4(sum / weights);
}
)glsl";

const char* const kFarthestFragmentShader = R"glsl(
uniform sampler2D u_depth;
uniform vec3 u_depth_to_w;
out float o_farthest;

float w_of(float depth) { return u_depth_to_w.x / (u_depth_to_w.y + u_depth_to_w.z * depth); }

// The farthest w in a tile of 8 x 8 samples (DepthTiles::kTile).
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * 8;
    ivec2 end = min(first + 8, textureSize(u_depth, 0));
    float low = 1.0, high = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            float depth = texelFetch(u_depth, ivec2(x, y), 0).r;
            low = min(low, depth);
            high = max(high, depth);
        }
    o_farthest = max(w_of(low), w_of(high));
}
)glsl";

} // namespace abut
