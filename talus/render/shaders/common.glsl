#version 450 core
// What every shader may use. View units: the scene fits the unit ball about the origin, z up.

const int kSunMaps = 4;

layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_view;           // depth: near at the eye's near plane, 0 at infinity
  mat4 sun_from_view[kSunMaps];  // all components in [0, 1]; the finest first
  vec4 sun_texels;               // size of a texel of each
  vec4 eye;                      // w: distance of the near plane
  vec4 forward;                  // unit; w: height of the ground
  vec4 right;                    // half the picture's width at distance 1; w: its width in pixels
  vec4 up;                       // half the picture's height at distance 1; w: its height in pixels
  vec4 sun;                      // unit, toward the sun; w: how many of its maps there are
  vec4 lengths;  // radius of the median stone, of its surroundings, pixel at distance 1, metres
  vec4 air;      // haze per unit; how far exposure adapts; -; -
} frame;

// One stone or mesh: view = position + scale * rotate(rotation, local).
struct Instance {
  vec4 position_scale;
  vec4 rotation;
  vec4 albedo_texture_scale;  // texture units per view unit; 0: one color; -1: many surfaces
  vec3 texture_offset;
  uint id;
};
layout(std430, binding = 0) readonly buffer Instances { Instance instances[]; };

const uint kSky = 0u;  // ids of stones and meshes count from 1
const uint kGround = 0xffffffffu;
const int kSamples = 2;  // per pixel and axis

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

vec3 placed(Instance instance, vec3 local) {
  return instance.position_scale.xyz +
         instance.position_scale.w * rotate(instance.rotation, local);
}

// Ray through a point of the picture in [0, 1]^2, with length 1 along the view direction.
vec3 view_ray(vec2 at) {
  vec2 ndc = 2.0 * at - 1.0;
  return frame.forward.xyz + ndc.x * frame.right.xyz + ndc.y * frame.up.xyz;
}

// Unit vectors as a point of an unfolded octahedron.
vec2 octahedral(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? n.xy : folded;
}
vec3 from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}

// Weights of the projections along x, y and z: powers of what of the normal faces them, divided by
// their sum ([Peytavie2009a] section 6). What adds nothing visible is left out.
vec3 projection_weights(vec3 n, float power) {
  vec3 w = pow(abs(n), vec3(power));
  w = max(w / (w.x + w.y + w.z) - 0.02, 0.0);
  return w / (w.x + w.y + w.z);
}
// One bit for each projection with a weight. Textures are read in a loop over such bits, each
// sample its own, since rasterizers in software run both sides of every branch.
uint faced_sides(vec3 weights) {
  return (weights.x > 0.0 ? 1u : 0u) | (weights.y > 0.0 ? 2u : 0u) | (weights.z > 0.0 ? 4u : 0u);
}

// Random bits from a place ([Jarzynski2020], pcg3d).
uvec3 random_bits(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v += v.yzx * v.zxy;
  v ^= v >> 16u;
  v += v.yzx * v.zxy;
  return v;
}
vec3 random(ivec2 cell, int what) {
  return vec3(random_bits(uvec3(uvec2(cell), uint(what))) >> 8u) * (1.0 / 16777216.0);
}
