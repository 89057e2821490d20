// Evens out the pattern of the occlusion along one axis, on one surface only.

layout(binding = 0) uniform sampler2D occlusion;
layout(binding = 1) uniform usampler2D seen;

layout(location = 0) uniform ivec2 axis;

layout(location = 0) out vec4 seen_sky;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 size = vec2(frame.right.w, frame.up.w);
  vec4 here = texelFetch(occlusion, texel, 0);
  vec3 n = from_octahedral(unpackSnorm2x16(texelFetch(seen, kSamples * texel, 0).y));
  vec3 p = here.y * view_ray((vec2(texel) + 0.25) / size);

  // Tolerance off the tangent plane: a share of a stone, yet never less than the picture resolves.
  float tolerance = max(0.15 * frame.lengths.x, 1.5 * here.y * frame.lengths.z);
  vec3 sum = here.xzw;
  float weights = 1.0;
  for (int i = -4; i <= 4; ++i) {
    if (i == 0) continue;
    ivec2 other = clamp(texel + i * axis, ivec2(0), ivec2(size) - 1);
    vec4 there = texelFetch(occlusion, other, 0);
    vec3 q = there.y * view_ray((vec2(other) + 0.25) / size);
    float weight = max(0.0, 1.0 - abs(dot(q - p, n)) / tolerance) * (1.0 - 0.15 * abs(float(i)));
    sum += weight * there.xzw;
    weights += weight;
  }
  sum /= weights;
  seen_sky = vec4(sum.x, here.y, sum.yz);
}
