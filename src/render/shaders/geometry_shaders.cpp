#include "render/shaders/geometry_shaders.h"

namespace abut {

const char* const kGeometryVertexShader = R"glsl(
uniform mat4 u_clip_from_world;
uniform vec3 u_lower, u_step;
#ifdef FLAGS
uniform sampler2D u_states;
#endif

#ifdef GROUND
uniform vec3 u_ground_centre, u_ground_x, u_ground_y, u_ground_normal;
#else
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec2 a_normal;
layout(location = 2) in uint a_part;
#endif
#ifdef INSTANCED
layout(location = 3) in vec4 a_row_x;
layout(location = 4) in vec4 a_row_y;
layout(location = 5) in vec4 a_row_z;
layout(location = 6) in uint a_instance_part;
#endif

flat out uint v_part;
out vec3 v_normal;
#if defined(SECTION) || defined(GHOSTS)
out vec3 v_world;
#endif

vec3 decode(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return n;
}

void main() {
#ifdef GROUND
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec3 world = u_ground_centre + corner.x * u_ground_x + corner.y * u_ground_y;
    v_normal = u_ground_normal;
    v_part = 0x3fffffffu;
#else
    vec3 world = u_lower + u_step * a_position;
    vec3 normal = decode(a_normal);
#ifdef INSTANCED
    world = vec3(dot(a_row_x, vec4(world, 1.0)), dot(a_row_y, vec4(world, 1.0)),
                 dot(a_row_z, vec4(world, 1.0)));
    // The matrix of cofactors maps normals as the winding of the triangles does, mirrored or not.
    normal = vec3(dot(cross(a_row_y.xyz, a_row_z.xyz), normal),
                  dot(cross(a_row_z.xyz, a_row_x.xyz), normal),
                  dot(cross(a_row_x.xyz, a_row_y.xyz), normal));
    uint part = a_instance_part;
#else
    uint part = a_part;
#endif
    v_normal = normal;
    v_part = part + 1u;
#ifdef FLAGS
    int flags = int(texelFetch(u_states, ivec2(int(part & 4095u), int(part >> 12)), 0).a * 255.0 +
                    0.5);
    v_part |= (flags & 4) != 0 ? 0x80000000u : 0u;
#endif
#endif
    gl_Position = u_clip_from_world * vec4(world, 1.0);
#if defined(SECTION) || defined(GHOSTS)
    v_world = world;
#endif
#ifdef FLAGS
    // A hidden part becomes one point outside of the clip space.
#ifdef GHOSTS
    if ((flags & 3) != 2)
#else
    if ((flags & 3) != 0)
#endif
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
#endif
}
)glsl";

const char* const kGeometryFragmentShader = R"glsl(
flat in uint v_part;
in vec3 v_normal;
#if defined(SECTION) || defined(GHOSTS)
in vec3 v_world;
#endif
#ifdef SECTION
uniform vec4 u_planes[13]; // kMostSections, and six of a section box
uniform int u_plane_count;
#endif
#ifdef GHOSTS
uniform vec3 u_eye;
layout(location = 0) out vec4 o_passed;
#else
layout(location = 0) out uvec2 o_part;
#endif

void main() {
#ifdef SECTION
    for (int i = 0; i < u_plane_count; ++i)
        if (dot(u_planes[i].xyz, v_world) > u_planes[i].w)
            discard;
#endif
#ifdef GHOSTS
    vec3 n = normalize(v_normal + vec3(1e-20));
    float rim = 1.0 - abs(dot(n, normalize(v_world - u_eye)));
    o_passed = vec4(1.0 - mix(0.035, 0.20, rim * rim));
#else
    uint part = v_part;
#ifdef SECTION
    if (!gl_FrontFacing)
        part |= 0x40000000u;
#endif
#ifdef QUICK
    uvec3 q = uvec3(ivec3(v_normal * (511.0 * inversesqrt(dot(v_normal, v_normal) + 1e-20)) +
                          512.5));
    o_part = uvec2(part, q.x | (q.y << 10) | (q.z << 20));
#else
    vec3 n = v_normal / (abs(v_normal.x) + abs(v_normal.y) + abs(v_normal.z) + 1e-20);
    vec2 e = n.z >= 0.0 ? n.xy : vec2(n.x >= 0.0 ? 1.0 - abs(n.y) : abs(n.y) - 1.0,
                                      n.y >= 0.0 ? 1.0 - abs(n.x) : abs(n.x) - 1.0);
    uvec2 q = uvec2(e * 32766.0 + 32767.5);
    o_part = uvec2(part, q.x | (q.y << 16));
#endif
#endif
}
)glsl";

} // namespace abut
