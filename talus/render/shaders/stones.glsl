// Stones, and the plane of earth and gravel they lie on.

layout(binding = 4) uniform sampler2D stone_relief;
layout(binding = 5) uniform sampler2D stone_color;
layout(binding = 6) uniform sampler2D gravel;

const float kTextureSize = 1024.0;
const float kStoneSlopeMax = 16.0;
const float kGravelSlopeMax = 64.0;

// Level of detail at which a texel of a texture with `scale` units per view unit is as large as a
// sample at distance `away`.
float detail(float scale, float away) {
  return log2(max(scale * kTextureSize * away * frame.lengths.z / float(kSamples), 1e-6));
}

// Slopes and colors of three projections, each weighted by how much the surface faces its axis.
// Weights sum to 1; the texture along an axis is read at the other two coordinates, not mirrored.
Material stone_material(Instance stone, vec3 p, vec3 normal, float away) {
  vec4 back = vec4(-stone.rotation.xyz, stone.rotation.w);
  float scale = stone.albedo_texture_scale.w;
  vec3 grain = scale * rotate(back, p - stone.position_scale.xyz);
  vec3 n = rotate(back, normal);
  vec3 weight = projection_weights(n, 4.0);

  const float kTiles = 0.3;  // textures per median stone radius
  vec3 uvw = kTiles * grain + stone.texture_offset;
  float lod = detail(kTiles * scale, away);
  vec4 relief = vec4(0.0);
  vec4 tint = vec4(0.0);
  vec3 gradient = vec3(0.0);
  for (uint sides = faced_sides(weight); sides != 0u; sides &= sides - 1u) {
    int axis = findLSB(sides);
    vec2 uv = axis == 0 ? uvw.yz : axis == 1 ? uvw.zx + 0.37 : uvw.xy + 0.71;
    vec4 r = textureLod(stone_relief, uv, lod);
    relief += weight[axis] * r;
    tint += weight[axis] * textureLod(stone_color, uv, lod);
    vec2 slope = weight[axis] * (r.xy - 0.5);
    gradient += axis == 0   ? vec3(0.0, slope)
                : axis == 1 ? vec3(slope.y, 0.0, slope.x)
                            : vec3(slope, 0.0);
  }

  // Faint beds across the stone, each stone's its own way.
  vec3 bed_axis = normalize(stone.texture_offset - 0.5 + vec3(0.0, 0.0, 0.6));
  float bed = dot(grain, bed_axis) * 3.0 + 2.2 * tint.x;
  float beds = 0.5 + 0.5 * sin(bed * 2.6) * sin(bed * 1.1 + 1.3);

  Material m;
  vec3 base = stone.albedo_texture_scale.rgb;
  m.albedo = base * (0.66 + 0.68 * tint.x) * (0.93 + 0.14 * beds);
  m.albedo = mix(m.albedo, m.albedo * vec3(1.12, 0.98, 0.82), smoothstep(0.45, 0.75, relief.z));
  m.albedo *= 1.0 - 0.45 * tint.z;
  m.albedo = mix(m.albedo, vec3(0.62, 0.60, 0.56), 0.45 * tint.y);
  m.albedo *= 1.0 - 0.6 * relief.w;

  // Dust and lichen where rain and light fall.
  float upward = smoothstep(0.15, 0.85, normal.z);
  m.albedo = mix(m.albedo, vec3(0.46, 0.41, 0.33), 0.22 * upward);
  vec3 lichen = mix(vec3(0.42, 0.42, 0.26), vec3(0.50, 0.50, 0.44), stone.texture_offset.x);
  float grown = smoothstep(0.35, 0.8, stone.texture_offset.y);
  m.albedo = mix(m.albedo, lichen, 0.55 * tint.w * grown * smoothstep(-0.2, 0.6, normal.z));

  // Bumps tilt the normal against the slope, as far as that lies in the surface.
  gradient *= 2.0 * kStoneSlopeMax * 0.085;
  m.normal = normalize(rotate(stone.rotation, n - (gradient - n * dot(gradient, n))));
  m.gloss = 0.25 + 0.5 * tint.y;
  m.gloss_power = 18.0;
  return m;
}

vec3 pebble_albedo(float shade) {
  float value = clamp((shade - 0.2) / 0.8, 0.0, 1.0);
  return mix(vec3(0.115, 0.105, 0.095), vec3(0.36, 0.315, 0.255), value * value);
}

// Earth with gravel in it: the same texture at two sizes, the larger one only in patches.
Material ground_material(vec3 p, float away, vec3 ray) {
  float scale = 0.12 / frame.lengths.x;
  // Grazing rays stretch a sample along the ground; between its two lengths lies a fair detail.
  // Farther away, where the repeat of a texture would show, it turns into its mean.
  float lod = detail(scale, away * inversesqrt(max(-normalize(ray).z, 0.02)));
  float blurred = lod + 1.5 * max(lod - 3.6, 0.0);
  const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8);
  vec2 uv = scale * p.xy;
  vec4 fine = textureLod(gravel, kTurn * kTurn * uv, blurred);
  vec4 coarse = textureLod(gravel, kTurn * uv * 0.61, blurred - 0.7);
  vec4 rough = textureLod(stone_relief, kTurn * uv * 0.83, lod + 2.0 * max(lod - 1.5, 0.0));
  vec4 tint = textureLod(stone_color, kTurn * uv * 0.47, lod - 1.1);
  vec4 region = textureLod(stone_color, uv.yx * 0.079, lod - 3.7);

  float stony = smoothstep(0.34, 0.68, 0.45 * tint.x + 0.55 * region.x);
  float large = smoothstep(0.05, 0.2, coarse.w) *
                smoothstep(0.46, 0.60, region.x + 0.4 * (tint.x - 0.5));
  float small = smoothstep(0.05, 0.2, fine.w) * mix(0.4, 1.0, stony) * (1.0 - large);
  vec3 earth = mix(vec3(0.165, 0.125, 0.085), vec3(0.29, 0.235, 0.17), 0.25 + 0.75 * tint.x);

  Material m;
  m.albedo = mix(earth * mix(1.05, 0.85, stony), pebble_albedo(fine.w), 0.85 * small);
  m.albedo = mix(m.albedo, pebble_albedo(coarse.w), 0.9 * large);
  m.albedo *= (0.65 + 0.7 * rough.z) * (0.82 + 0.3 * mix(fine.z, coarse.z, large));
  // Slopes turn back as the coordinates were turned.
  vec2 slope = mix(mix(0.5, 1.0, stony) * (fine.xy - 0.5) * kTurn, coarse.xy - 0.5, large);
  slope = (0.034 * kGravelSlopeMax * slope + 0.09 * kStoneSlopeMax * (rough.xy - 0.5)) * kTurn;
  m.normal = normalize(vec3(-slope, 1.0));
  m.gloss = 0.1;
  m.gloss_power = 18.0;
  return m;
}
