// Scene as the sun sees it; only depth is kept.

layout(location = 0) in vec3 position;
layout(location = 2) in vec4 instance_position_scale;
layout(location = 3) in vec4 instance_rotation;

void main() {
  vec3 view = instance_position_scale.xyz +
              instance_position_scale.w * rotate(instance_rotation, position);
  vec3 at = (frame.sun_from_view * vec4(view, 1.0)).xyz;
  gl_Position = vec4(2.0 * at.xy - 1.0, at.z, 1.0);
}
