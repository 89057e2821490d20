// Scene of which only depth is kept.

layout(location = 0) in vec3 position;
layout(location = 2) in uint pick;

layout(location = 0) uniform mat4 clip_from_view;

void main() { gl_Position = clip_from_view * vec4(placed(instances[pick], position), 1.0); }
