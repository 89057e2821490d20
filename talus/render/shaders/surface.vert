// Scene as the camera sees it.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 instance_position_scale;
layout(location = 3) in vec4 instance_rotation;
layout(location = 4) in uint instance_id;

out vec3 surface_normal;
flat out uint surface_id;

void main() {
  vec3 view = instance_position_scale.xyz +
              instance_position_scale.w * rotate(instance_rotation, position);
  gl_Position = frame.clip_from_view * vec4(view, 1.0);
  surface_normal = rotate(instance_rotation, normal.xyz);
  surface_id = instance_id;
}
