// Evens out the pattern of the occlusion along one axis, on one surface only.

layout(binding = 0) uniform sampler2D occlusion;
layout(binding = 1) uniform usampler2D surfaces;

layout(location = 0) uniform ivec2 axis;

layout(location = 0) out vec2 visibility_distance;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 size = vec2(frame.right.w, frame.up.w);
  vec2 here = texelFetch(occlusion, texel, 0).xy;
  vec3 n = from_octahedral(unpackSnorm2x16(texelFetch(surfaces, kSamples * texel, 0).y));
  vec3 p = here.y * view_ray((vec2(texel) + 0.25) / size);

  // Tolerance off the tangent plane: a share of a stone, yet never less than the picture resolves.
  float tolerance = max(0.15 * frame.lengths.x, 1.5 * here.y * frame.lengths.z);
  float sum = here.x;
  float weights = 1.0;
  for (int i = -4; i <= 4; ++i) {
    if (i == 0) continue;
    ivec2 other = clamp(texel + i * axis, ivec2(0), ivec2(size) - 1);
    vec2 there = texelFetch(occlusion, other, 0).xy;
    vec3 q = there.y * view_ray((vec2(other) + 0.25) / size);
    float weight = max(0.0, 1.0 - abs(dot(q - p, n)) / tolerance) * (1.0 - 0.15 * abs(float(i)));
    sum += weight * there.x;
    weights += weight;
  }
  visibility_distance = vec2(sum / weights, here.y);
}
