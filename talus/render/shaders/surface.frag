// Which surface a sample shows: the picture is shaded afterwards.

in vec3 surface_normal;
flat in uint surface_id;

layout(location = 0) out uvec2 surface;

#ifdef SHARES
in vec4 low;
in vec4 high;
layout(location = 1) out uvec2 shares;
#endif

void main() {
  vec3 n = gl_FrontFacing ? surface_normal : -surface_normal;
  surface = uvec2(surface_id, packSnorm2x16(octahedral(normalize(n))));
#ifdef SHARES
  shares = uvec2(packUnorm4x8(low), packUnorm4x8(high));
#endif
}
