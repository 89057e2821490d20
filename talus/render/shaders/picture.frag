// The picture: each sample of the surfaces is lit, fogged and toned; a pixel is their mean.

layout(binding = 0) uniform usampler2D surfaces;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D occlusion;
layout(binding = 3) uniform sampler2DShadow shadows;
layout(binding = 4) uniform sampler2D stone_relief;
layout(binding = 5) uniform sampler2D stone_color;
layout(binding = 6) uniform sampler2D gravel;
layout(std430, binding = 0) readonly buffer Instances { Instance instances[]; };

layout(location = 0) out vec4 color;

const float kTextureSize = 1024.0;
const float kStoneSlopeMax = 16.0;
const float kGravelSlopeMax = 64.0;

struct Material {
  vec3 albedo;
  vec3 normal;
  float gloss;
};

vec3 sun_color() {
  float height = frame.sun.z;
  return 3.1 * mix(vec3(1.0, 0.55, 0.26), vec3(1.0, 0.89, 0.73), smoothstep(0.0, 0.6, height));
}

// Sky in a direction: pale at the horizon, deep above, bright around the sun.
vec3 sky(vec3 direction) {
  float height = max(direction.z, 0.0);
  float day = smoothstep(0.05, 0.5, frame.sun.z);
  vec3 haze = mix(vec3(0.84, 0.74, 0.64), vec3(0.80, 0.82, 0.82), day);
  vec3 blue = vec3(0.21, 0.38, 0.66);
  vec3 zenith = vec3(0.10, 0.20, 0.44);
  vec3 clear = mix(mix(haze, blue, 1.0 - exp(-8.0 * height)), zenith, smoothstep(0.0, 0.9, height));
  float toward = max(dot(direction, frame.sun.xyz), 0.0);
  return clear + sun_color() * (0.035 * pow(toward, 5.0) + 0.08 * pow(toward, 48.0));
}

// Light of the sky and of the sunlit earth on a surface that sees all of both.
vec3 ambient(vec3 normal) {
  vec3 above = vec3(0.44, 0.53, 0.70);
  vec3 below = vec3(0.27, 0.21, 0.15) * (0.35 + 0.65 * frame.sun.z);
  return mix(below, above, 0.5 + 0.5 * normal.z);
}

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
  vec3 weight = pow(abs(n), vec3(4.0));
  weight /= weight.x + weight.y + weight.z;

  const float kTiles = 0.3;  // textures per median stone radius
  vec3 uvw = kTiles * grain + stone.texture_offset;
  float lod = detail(kTiles * scale, away);
  vec4 relief_x = textureLod(stone_relief, uvw.yz, lod);
  vec4 relief_y = textureLod(stone_relief, uvw.zx + 0.37, lod);
  vec4 relief_z = textureLod(stone_relief, uvw.xy + 0.71, lod);
  vec4 tint = weight.x * textureLod(stone_color, uvw.yz, lod) +
              weight.y * textureLod(stone_color, uvw.zx + 0.37, lod) +
              weight.z * textureLod(stone_color, uvw.xy + 0.71, lod);
  vec4 relief = weight.x * relief_x + weight.y * relief_y + weight.z * relief_z;

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
  vec2 slope_x = relief_x.xy - 0.5;
  vec2 slope_y = relief_y.xy - 0.5;
  vec2 slope_z = relief_z.xy - 0.5;
  vec3 gradient = weight.x * vec3(0.0, slope_x) + weight.y * vec3(slope_y.y, 0.0, slope_y.x) +
                  weight.z * vec3(slope_z, 0.0);
  gradient *= 2.0 * kStoneSlopeMax * 0.085;
  m.normal = normalize(rotate(stone.rotation, n - (gradient - n * dot(gradient, n))));
  m.gloss = 0.25 + 0.5 * tint.y;
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
  return m;
}

// Share of the sun that a surface sees: a disk of comparisons, turned anew at each sample.
float sunlight(vec3 p, vec3 normal, ivec2 texel) {
  float texel_size = frame.sun.w;
  float sine = sqrt(max(1.0 - pow(dot(normal, frame.sun.xyz), 2.0), 0.0));
  vec3 at = (frame.sun_from_view * vec4(p + normal * texel_size * (0.7 + 3.0 * sine), 1.0)).xyz;
  // Beyond the last thing that casts a shadow only its shadow ends the light, not the map.
  at.z = max(at.z, 1e-6);
  float turn = 6.2831853 * random(texel, 1).x;
  float lit = 0.0;
  const int kTaps = 8;
  for (int i = 0; i < kTaps; ++i) {
    float angle = turn + 2.39996323 * float(i);
    float radius = 2.2 * sqrt((float(i) + 0.5) / float(kTaps));
    vec2 offset = radius * vec2(cos(angle), sin(angle));
    lit += texture(shadows, vec3(at.xy + offset / vec2(textureSize(shadows, 0)), at.z));
  }
  return lit / float(kTaps);
}

// Occlusion was found once per pixel: takes it from those neighbours that lie on the same surface.
float sky_visibility(ivec2 pixel, vec3 p, vec3 normal, vec2 size) {
  float tolerance = max(0.08 * frame.lengths.x, 1e-6);
  float sum = 0.0;
  float weights = 0.0;
  for (int i = 0; i < 5; ++i) {
    ivec2 offset = ivec2((i == 1 ? 1 : 0) - (i == 2 ? 1 : 0), (i == 3 ? 1 : 0) - (i == 4 ? 1 : 0));
    ivec2 other = clamp(pixel + offset, ivec2(0), ivec2(size) - 1);
    vec2 there = texelFetch(occlusion, other, 0).xy;
    vec3 q = frame.eye.xyz + there.y * view_ray((vec2(other) + 0.25) / size);
    float off_plane = abs(dot(q - p, normal)) / tolerance;
    float weight = exp2(-4.0 * min(off_plane, 8.0)) * (i == 0 ? 2.0 : 1.0);
    sum += weight * there.x;
    weights += weight;
  }
  return sum / weights;
}

// Light that reaches a crevice after bouncing off its own walls ([Jimenez2016], eq. 10).
vec3 many_bounces(float visibility, vec3 albedo) {
  vec3 a = 2.0404 * albedo - 0.3324;
  vec3 b = -4.7951 * albedo + 0.6417;
  vec3 c = 2.7552 * albedo + 0.6903;
  return max(vec3(visibility), ((visibility * a + b) * visibility + c) * visibility);
}

vec3 shade(ivec2 texel, vec2 size) {
  vec3 ray = view_ray((vec2(texel) + 0.5) / (float(kSamples) * size));
  uvec2 surface = texelFetch(surfaces, texel, 0).xy;
  if (surface.x == kSky) return sky(normalize(ray));

  float away = frame.eye.w / texelFetch(depths, texel, 0).x;
  vec3 p = frame.eye.xyz + away * ray;
  vec3 normal = from_octahedral(unpackSnorm2x16(surface.y));
  vec3 toward_eye = -normalize(ray);

  Material m;
  if (surface.x == kGround) {
    m = ground_material(p, away, ray);
  } else {
    Instance instance = instances[surface.x - 1u];
    if (instance.albedo_texture_scale.w > 0.0)
      m = stone_material(instance, p, normal, away);
    else
      m = Material(instance.albedo_texture_scale.rgb, normal, 0.15);
  }

  float open = sky_visibility(texel / kSamples, p, normal, size);
  float facing = dot(m.normal, frame.sun.xyz);
  float flat_facing = dot(normal, frame.sun.xyz);
  vec3 sun = vec3(0.0);
  if (facing > 0.0 && flat_facing > 0.0) {
    float lit = sunlight(p, normal, texel) * smoothstep(0.0, 0.12, flat_facing);
    // Rough stone: a weak, broad gleam.
    vec3 half_way = normalize(toward_eye + frame.sun.xyz);
    float gleam = m.gloss * 0.10 * pow(max(dot(m.normal, half_way), 0.0), 18.0);
    sun = sun_color() * lit * facing * (m.albedo + gleam);
  }
  vec3 light = sun + m.albedo * ambient(m.normal) * many_bounces(open, m.albedo);

  // The ground fades into the haze from a few scenes away on.
  if (surface.x == kGround) {
    float far = length(p.xy) / 9.0;
    light = mix(light, sky(normalize(vec3(ray.xy, 0.0))), 1.0 - exp(-far * far));
  }
  return light;
}

// Film's shoulder and toe: fit of the ACES reference transforms ([Hill2017]), then sRGB.
vec3 tone(vec3 light) {
  const mat3 kInput = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566,
                           0.83777);
  const mat3 kOutput = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367,
                            -0.00605, 1.07602);
  vec3 v = kInput * light;
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  v = clamp(kOutput * v, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 size = vec2(frame.right.w, frame.up.w);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kSamples * kSamples; ++i)
    sum += tone(shade(kSamples * pixel + ivec2(i % kSamples, i / kSamples), size));
  vec3 mean = sum / float(kSamples * kSamples);
  // Half a step of noise keeps the sky's gradient from banding.
  color = vec4(mean + (random(pixel, 2).x - 0.5) / 255.0, 1.0);
}
