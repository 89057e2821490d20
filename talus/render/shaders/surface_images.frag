// A material's texture from a user's pictures, brought to one size. Row 0 of a picture is its top.

layout(binding = 0) uniform sampler2D albedo;  // linear after sampling; a: perhaps height
layout(binding = 1) uniform sampler2D normal;
layout(binding = 2) uniform sampler2D roughness;
layout(binding = 3) uniform sampler2D height;

layout(location = 0) uniform ivec4 has;  // normal, roughness in its own picture, height likewise,
                                         // bits: 1 height in the albedo, 2 roughness in the normal

layout(location = 0) out vec4 color_height;
layout(location = 1) out vec4 relief;  // as in surface_relief.frag

const float kSize = 512.0;
const float kSlopeMax = 4.0;

void main() {
  vec2 at = gl_FragCoord.xy / kSize;
  vec2 uv = vec2(at.x, 1.0 - at.y);
  vec4 c = texture(albedo, uv);
  float h = has.z != 0 ? texture(height, uv).x : (has.w & 1) != 0 ? c.a : 0.5;
  color_height = vec4(sqrt(c.rgb), h);
  vec4 n = texture(normal, uv);
  float rough = has.y != 0 ? texture(roughness, uv).x : (has.w & 2) != 0 ? n.a : 0.9;
  vec3 direction = has.x != 0 ? n.xyz * (255.0 / 127.0) - 128.0 / 127.0 : vec3(0.0, 0.0, 1.0);
  vec2 slope = -direction.xy / max(direction.z, 0.2);
  relief = vec4(0.5 + 0.5 * clamp(slope / kSlopeMax, -1.0, 1.0), rough, 0.5);
}
