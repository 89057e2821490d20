// Scene as the camera sees it.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in uint pick;

out vec3 surface_normal;
flat out uint surface_id;

#ifdef SHARES
layout(location = 3) in vec4 shares_low;
layout(location = 4) in vec4 shares_high;
out vec4 low;
out vec4 high;
#endif

void main() {
  Instance instance = instances[pick];
  gl_Position = frame.clip_from_view * vec4(placed(instance, position), 1.0);
  surface_normal = rotate(instance.rotation, normal.xyz);
  surface_id = instance.id;
#ifdef SHARES
  low = shares_low;
  high = shares_high;
#endif
}
