// Slopes and hollows of a material's texture, from its heights.

layout(binding = 0) uniform sampler2D heights;  // in units of the texture's width; roughness

layout(location = 0) out vec4 relief;  // slope along x and y; roughness; hollow

const int kSize = 512;
const float kSlopeMax = 4.0;

float height_at(ivec2 texel) { return texelFetch(heights, (texel + kSize) & (kSize - 1), 0).x; }

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 slope = 0.5 * float(kSize) *
               vec2(height_at(texel + ivec2(1, 0)) - height_at(texel - ivec2(1, 0)),
                    height_at(texel + ivec2(0, 1)) - height_at(texel - ivec2(0, 1)));
  float around = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.7853982 * float(i);
    float reach = (i & 1) == 0 ? 5.0 : 3.0;
    around += height_at(texel + ivec2(round(reach * vec2(cos(angle), sin(angle)))));
  }
  float hollow = (height_at(texel) - around / 8.0) * 60.0;
  relief = vec4(0.5 + 0.5 * clamp(slope / kSlopeMax, -1.0, 1.0), texelFetch(heights, texel, 0).y,
                clamp(0.5 + hollow, 0.0, 1.0));
}
