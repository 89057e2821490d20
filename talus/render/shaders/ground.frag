// The endless ground, behind whatever was drawn before.

layout(location = 0) out uvec2 surface;

void main() {
  vec2 size = kSamples * vec2(frame.right.w, frame.up.w);
  vec3 ray = view_ray(gl_FragCoord.xy / size);
  float away = frame.forward.w - frame.eye.z;
  // Seen from above only; rays that graze the horizon meet the sky's haze either way.
  if (away >= 0.0 || ray.z > -1e-5) discard;
  gl_FragDepth = frame.eye.w * ray.z / away;
  surface = uvec2(kGround, packSnorm2x16(octahedral(vec3(0.0, 0.0, 1.0))));
}
