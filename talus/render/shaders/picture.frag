// The picture: what the samples show is lit, fogged and toned; a pixel is their mean. With METER it
// is instead a small picture of the light itself, from which the exposure is found.

layout(binding = 0) uniform usampler2D seen;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D occlusion;
#ifdef LANDSCAPE
layout(binding = 10) uniform usampler2D seen_shares;
#endif
#ifdef WATER
layout(binding = 11) uniform sampler2D water_depths;
#endif
#ifndef METER
layout(binding = 12) uniform sampler2D meter;
#endif

layout(location = 0) out vec4 color;

// What one or several samples show.
struct Sample {
  uint id;
  vec3 ray;  // of length 1 along the view direction
  float away;
  vec3 normal;
  vec4 low;  // shares of surfaces
  vec4 high;
};

Sample sample_at(ivec2 texel, vec2 size) {
  Sample s;
  s.ray = view_ray((vec2(texel) + 0.5) / (float(kSamples) * size));
  uvec2 surface = texelFetch(seen, texel, 0).xy;
  s.id = surface.x;
  s.away = frame.eye.w / max(texelFetch(depths, texel, 0).x, 1e-20);
  s.normal = from_octahedral(unpackSnorm2x16(surface.y));
#ifdef LANDSCAPE
  uvec2 shares = texelFetch(seen_shares, texel, 0).xy;
  s.low = unpackUnorm4x8(shares.x);
  s.high = unpackUnorm4x8(shares.y);
#endif
  return s;
}

// Occlusion was found once per pixel: takes it from those neighbors that lie on the same surface.
// As occlusion.frag has it, without the distance.
vec3 sky_visibility(ivec2 pixel, vec3 p, vec3 normal, vec2 size) {
  float tolerance = max(0.08 * frame.lengths.x, 1e-6);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 5; ++i) {
    ivec2 offset = ivec2((i == 1 ? 1 : 0) - (i == 2 ? 1 : 0), (i == 3 ? 1 : 0) - (i == 4 ? 1 : 0));
    ivec2 other = clamp(pixel + offset, ivec2(0), ivec2(size) - 1);
    vec4 there = texelFetch(occlusion, other, 0);
    vec3 q = frame.eye.xyz + there.y * view_ray((vec2(other) + 0.25) / size);
    float off_plane = abs(dot(q - p, normal)) / tolerance;
    float weight = exp2(-4.0 * min(off_plane, 8.0)) * (i == 0 ? 2.0 : 1.0);
    sum += weight * there.xzw;
    weights += weight;
  }
  return sum / weights;
}

vec3 lit(Material m, Sample s, vec3 p, vec3 open, ivec2 texel) {
  vec3 toward_eye = -normalize(s.ray);
  float facing = dot(m.normal, frame.sun.xyz);
  float flat_facing = dot(s.normal, frame.sun.xyz);
  vec3 light = m.albedo * ambient(m.normal, open, m.albedo);
  if (facing > 0.0 && flat_facing > 0.0) {
    float reached = sunlight(p, s.normal, texel) * smoothstep(0.0, 0.12, flat_facing);
    // Rough stone: a weak, broad gleam.
    vec3 half_way = normalize(toward_eye + frame.sun.xyz);
    float gleam = m.gloss * 0.10 * pow(max(dot(m.normal, half_way), 0.0), m.gloss_power);
    light += sun_color() * reached * facing * (m.albedo + gleam);
  }
#ifdef LANDSCAPE
  // Light from sunlit ground around, where rock hides a part of the sky but not all.
  light += m.albedo * fill_light() * open.y * (1.0 - open.x) *
           mix(0.10, 1.0, smoothstep(0.0, 0.3, open.z));
#ifndef METER
  // Walls of a cave light each other.
  light += m.albedo * textureLod(meter, vec2(0.5), 16.0).rgb * frame.air.y * open.y;
#endif
#endif
  return light;
}

#ifdef WATER
// Water over what lies `depth` behind it along the ray: absorbs, scatters, mirrors the sky.
vec3 through_water(vec3 below, vec3 ray, vec3 p, float depth, ivec2 texel) {
  vec3 direction = normalize(ray);
  vec3 from_eye = (p - frame.eye.xyz) * frame.lengths.w;
  float footprint = length(from_eye) * frame.lengths.z;
  float calm = 1.0 / (1.0 + 40.0 * footprint);
  vec2 slope = 0.10 * calm * (clouds_at(0, 9.0, from_eye, footprint).xy +
                              clouds_at(0, 31.0, from_eye, footprint).yz - 1.0);
  vec3 n = normalize(vec3(slope, 1.0));
  vec3 mirrored = reflect(direction, n);
  mirrored.z = abs(mirrored.z);
  float fresnel = 0.02 + 0.98 * pow(1.0 - clamp(dot(-direction, n), 0.0, 1.0), 5.0);
  vec3 through = exp(-depth * frame.lengths.w * vec3(0.45, 0.13, 0.09));
  const vec3 kUp = vec3(0.0, 0.0, 1.0);
  vec3 scattered = vec3(0.012, 0.050, 0.055) * (ambient(kUp, vec3(1.0), vec3(0.0)) +
                                                0.3 * sun_color() * frame.sun.z);
  float reached = sunlight(p, kUp, texel);
  float glint = pow(max(dot(mirrored, frame.sun.xyz), 0.0), 900.0) * 12.0 * reached;
  return mix(mix(scattered, below, through), sky(mirrored), fresnel) + glint * sun_color();
}
#endif

vec3 shade(Sample s, ivec2 texel, vec2 size) {
  vec3 direction = normalize(s.ray);
  vec3 light = vec3(0.0);
  vec3 p = frame.eye.xyz + s.away * s.ray;
  if (s.id != kSky) {
    vec3 open = sky_visibility(texel / kSamples, p, s.normal, size);
    Material m = Material(vec3(0.0), s.normal, 0.15, 18.0);
#ifdef PLANE
    if (s.id == kGround) m = ground_material(p, s.away, s.ray);
#endif
    if (s.id != kGround) {
      Instance instance = instances[s.id - 1u];
      float kind = instance.albedo_texture_scale.w;
      if (kind == 0.0) m.albedo = instance.albedo_texture_scale.rgb;
#ifdef STONES
      if (kind > 0.0) m = stone_material(instance, p, s.normal, s.away);
#endif
#ifdef LANDSCAPE
      if (kind < 0.0) {
        // Grazing rays stretch a sample; between its two lengths lies a fair one.
        float facing = max(abs(dot(s.normal, direction)), 0.06);
        float footprint = s.away * frame.lengths.z * frame.lengths.w * inversesqrt(facing);
        m = landscape_material(s.away * s.ray * frame.lengths.w, s.normal, s.low, s.high,
                               footprint);
      }
#endif
    }
    light = lit(m, s, p, open, texel);
  }
  if (s.id == kSky) light = sky(direction);

#ifdef WATER
  float depth = texelFetch(water_depths, texel, 0).x;
  float near = frame.eye.w / max(depth, 1e-20);
  if (depth > 0.0 && (s.id == kSky || near < s.away)) {
    vec3 q = frame.eye.xyz + near * s.ray;
    float through = s.id == kSky ? 1e3 : (s.away - near) * length(s.ray);
    light = through_water(light, s.ray, q, through, texel);
  }
#endif
#ifdef LANDSCAPE
  // Air between the eye and what it sees.
  if (s.id != kSky) {
    float clear = exp(-frame.air.x * s.away * length(s.ray));
    light = mix(haze(direction), light, clear);
  }
#else
  // The ground fades into the haze from a few scenes away on.
  if (s.id == kGround) {
    float far = length(p.xy) / 9.0;
    light = mix(light, sky(normalize(vec3(s.ray.xy, 0.0))), 1.0 - exp(-far * far));
  }
#endif
  return light;
}

#ifdef METER

void main() {
  vec2 size = vec2(frame.right.w, frame.up.w);
  ivec2 texel = ivec2(gl_FragCoord.xy / 64.0 * float(kSamples) * size);
  vec3 light = min(shade(sample_at(texel, size), texel, size), vec3(4.0));
  color = vec4(light, log(dot(light, vec3(0.2126, 0.7152, 0.0722)) + 1e-4));
}

#else

// Eyes get used to a cave: less light than usual counts as more.
float exposure() {
  float usual = 0.12;
  float mean = exp(textureLod(meter, vec2(0.5), 16.0).a);
  return mix(1.0, clamp(usual / mean, 1.0, 40.0), frame.air.y);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 size = vec2(frame.right.w, frame.up.w);
  float exposed = exposure();
  int count = kSamples * kSamples;
#ifdef LANDSCAPE
  // The samples of one smooth piece of ground are shaded as one.
  Sample mean = sample_at(kSamples * pixel, size);
  vec3 place = mean.away * mean.ray;
  vec3 n = mean.normal;
  float tolerance = 1.5 * mean.away * frame.lengths.z;
  bool alike = mean.id == kSky ||
               (mean.id != kGround && instances[mean.id - 1u].albedo_texture_scale.w < 0.0);
  for (int i = 1; i < kSamples * kSamples; ++i) {
    Sample s = sample_at(kSamples * pixel + ivec2(i % kSamples, i / kSamples), size);
    alike = alike && s.id == mean.id &&
            (mean.id == kSky || (dot(s.normal, n) > 0.9 &&
                                 abs(dot(s.away * s.ray - place, n)) < tolerance));
    mean.ray += s.ray;
    mean.away += s.away;
    mean.normal += s.normal;
    mean.low += s.low;
    mean.high += s.high;
  }
  if (alike) count = 1;
#endif
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    ivec2 texel = kSamples * pixel + ivec2(i % kSamples, i / kSamples);
    Sample s = sample_at(texel, size);
#ifdef LANDSCAPE
    if (count == 1) {
      const float kShare = 1.0 / float(kSamples * kSamples);
      s = Sample(mean.id, kShare * mean.ray, kShare * mean.away, normalize(mean.normal),
                 kShare * mean.low, kShare * mean.high);
    }
#endif
    sum += tone(exposed * shade(s, texel, size));
  }
  // Half a step of noise keeps the sky's gradient from banding.
  color = vec4(sum / float(count) + (random(pixel, 2).x - 0.5) / 255.0, 1.0);
}

#endif
