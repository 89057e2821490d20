// Which surface a sample shows: the picture is shaded afterwards, once per sample.

in vec3 surface_normal;
flat in uint surface_id;

layout(location = 0) out uvec2 surface;

void main() {
  vec3 n = gl_FrontFacing ? surface_normal : -surface_normal;
  surface = uvec2(surface_id, packSnorm2x16(octahedral(normalize(n))));
}
