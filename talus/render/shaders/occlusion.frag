// How much of the sky each pixel's surface sees, from the depth around it: horizon-based ambient
// occlusion, [Jimenez2016] "Practical real-time strategies for accurate indirect occlusion".
// Each slice looks closely at the crevices next to a stone, then widely at the large form.

layout(binding = 0) uniform usampler2D seen;
layout(binding = 1) uniform sampler2D depths;

#ifdef LANDSCAPE
layout(binding = 2) uniform sampler2DArrayShadow sky_maps;

const int kSkyMaps = 24;
layout(std140, binding = 2) uniform Sky {
  mat4 sky_from_view[kSkyMaps];     // all components in [0, 1]
  vec4 sky_directions[kSkyMaps];  // unit; w: size of a texel
};
#endif

// Share of the sky that is seen; distance; the share that things near by leave; how open the place
// is whatever its surface faces.
layout(location = 0) out vec4 seen_sky;

const float kPi = 3.14159265;
const int kSlices = 2;
const int kNearSteps = 5;
const int kFarSteps = 4;

vec3 position_at(ivec2 texel, vec2 size) {
  float depth = texelFetch(depths, texel, 0).x;
  return frame.eye.xyz + (frame.eye.w / max(depth, 1e-9)) * view_ray((vec2(texel) + 0.5) / size);
}

// Cosine-weighted share of a slice that is open between its normal `n` and horizon `h`.
float open_share(float h, float n) {
  return 0.25 * (-cos(2.0 * h - n) + cos(n) + 2.0 * h * sin(n));
}

#ifdef LANDSCAPE
// Share of the sky that large forms leave open, from every fourth of its maps; the blur brings the
// four together. x: of what the surface faces, by the cosine; y: of all. `away`: leads out of the
// large form.
vec2 sky_share(vec3 p, vec3 n, vec3 away, int order) {
  const int kStride = 4;
  float faced = 0.0;
  float all = 0.0;
  float total = 0.0;
  for (int i = order & (kStride - 1); i < kSkyMaps; i += kStride) {
    vec3 direction = sky_directions[i].xyz;
    float facing = dot(n, direction);
    float weight = max(facing, 0.0);
    float texel = sky_directions[i].w;
    float sine = sqrt(max(1.0 - facing * facing, 0.0));
    vec3 at = (sky_from_view[i] * vec4(p + away * texel * (0.8 + 1.6 * sine), 1.0)).xyz;
    float open = texture(sky_maps, vec4(at.xy, float(i), max(at.z, 1e-6)));
    faced += weight * open;
    all += open;
    total += weight;
  }
  return vec2(faced / max(total, 1e-6), all * float(kStride) / float(kSkyMaps));
}
#endif

void main() {
  ivec2 texel = kSamples * ivec2(gl_FragCoord.xy);
  uvec2 surface = texelFetch(seen, texel, 0).xy;
  if (surface.x == kSky) {
    seen_sky = vec4(1.0, 1e9, 1.0, 0.0);
    return;
  }
  vec2 size = kSamples * vec2(frame.right.w, frame.up.w);
  vec3 p = position_at(texel, size);
  vec3 n = from_octahedral(unpackSnorm2x16(surface.y));
  float away = dot(p - frame.eye.xyz, frame.forward.xyz);
  vec3 v = normalize(frame.eye.xyz - p);
  vec3 right = normalize(frame.right.xyz);
  vec3 up = normalize(frame.up.xyz);

  float near_radius = 1.3 * frame.lengths.x;
  float far_radius = frame.lengths.y;
  float pixels_per_unit = float(kSamples) / (away * frame.lengths.z);

  // A pattern of 4 x 4 pixels, which the blur evens out.
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  int order = (cell.x * 4 + ((cell.x + cell.y) & 3) * 5) & 15;
  float turn = (float(order) + 0.5) / 16.0;
  float jitter = fract(0.5 + float(cell.y * 4 + cell.x) * 0.61803399);

  float visibility = 0.0;
  for (int slice = 0; slice < kSlices; ++slice) {
    float angle = kPi * (float(slice) + turn) / float(kSlices);
    vec2 step_direction = vec2(cos(angle), sin(angle));
    vec3 along = step_direction.x * right + step_direction.y * up;
    along = normalize(along - v * dot(along, v));
    vec3 across = cross(along, v);
    vec3 projected = n - across * dot(n, across);
    float projected_length = length(projected);
    float cos_n = clamp(dot(projected, v) / max(projected_length, 1e-6), -1.0, 1.0);
    float angle_n = sign(dot(projected, along)) * acos(cos_n);

    for (int side = 0; side < 2; ++side) {
      float direction = side == 0 ? -1.0 : 1.0;
      // Below this the surface itself hides the sky.
      float lowest = cos(direction * 0.5 * kPi + angle_n);
      float horizon = lowest;
      for (int i = 0; i < kNearSteps + kFarSteps; ++i) {
        float reach;
        if (i < kNearSteps) {
          float t = (float(i) + jitter) / float(kNearSteps);
          reach = near_radius * t * t;
        } else {
          float t = (float(i - kNearSteps) + jitter) / float(kFarSteps);
          reach = mix(near_radius, far_radius, t * t);
        }
        vec2 offset = direction * step_direction * max(reach * pixels_per_unit, 1.5 + float(i));
        ivec2 other = texel + ivec2(round(offset));
        if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(size)))) break;
        vec3 d = position_at(other, size) - p;
        float distance = length(d);
        // What is far in front is not near: it hides nothing here.
        float weight = 1.0 - smoothstep(0.35, 1.0, distance / far_radius);
        horizon = max(horizon, mix(lowest, dot(d, v) / max(distance, 1e-9), weight));
      }
      float h = direction * acos(clamp(horizon, -1.0, 1.0));
      h = angle_n + clamp(h - angle_n, -0.5 * kPi, 0.5 * kPi);
      visibility += projected_length * open_share(h, angle_n);
    }
  }
  visibility = clamp(visibility / float(kSlices), 0.0, 1.0);
#ifdef LANDSCAPE
  // The large forms are coarse: a stone's underside must not be taken for a place below the ground.
  bool stone = surface.x != kGround && instances[surface.x - 1u].albedo_texture_scale.w > 0.0;
  vec2 open = sky_share(p, n, stone ? vec3(n.xy, abs(n.z)) : n, order);
  seen_sky = vec4(visibility * open.x, away, visibility, open.y);
#else
  seen_sky = vec4(visibility, away, visibility, 1.0);
#endif
}
