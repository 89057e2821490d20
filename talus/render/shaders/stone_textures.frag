// The textures of stone, made once: they repeat after one unit.

layout(location = 0) out vec4 stone_relief;  // slope along x, y; height; crack
layout(location = 1) out vec4 stone_color;   // mottling, light grains, dark grains, lichen

const float kSize = 1024.0;  // texels on a side

// Cracks as parts of the borders between warped cells.
float crack(vec2 uv) {
  vec2 warped = uv + 0.06 * vec2(cloud(uv, 6, 4, 100), cloud(uv, 6, 4, 110));
  vec4 c = cells(warped, 4, 120);
  float broken = smoothstep(0.5, 0.62, cloud(uv, 5, 3, 130));
  return broken * (1.0 - smoothstep(0.0, 0.05, c.y - c.x));
}

float stone_height(vec2 uv) {
  float lumps = cloud(uv, 8, 6, 200);
  float pits = smoothstep(0.62, 0.8, cloud(uv, 40, 3, 220));
  return lumps - 0.12 * pits - 0.16 * crack(uv);
}

void main() {
  vec2 uv = gl_FragCoord.xy / kSize;

  // Slopes are stored around 1/2; 1 stands for the largest, as named in stones.glsl.
  float height = stone_height(uv);
  vec2 slope = vec2(dFdxFine(height), dFdyFine(height));
  stone_relief = vec4(0.5 + 0.5 * slope * kSize / 16.0, height, crack(uv));

  vec4 grain = cells(uv, 96, 400);
  vec4 fine_grain = cells(uv, 150, 410);
  float inside = 1.0 - smoothstep(0.3, 0.5, grain.x);
  float fine_inside = 1.0 - smoothstep(0.3, 0.5, fine_grain.x);
  float light = max(inside * step(0.86, grain.z), fine_inside * step(0.9, fine_grain.z));
  float dark = max(inside * step(grain.z, 0.1), fine_inside * step(fine_grain.z, 0.14));
  float patches = cloud(uv + 0.03 * cloud(uv, 12, 3, 420), 5, 6, 430);
  stone_color = vec4(cloud(uv, 4, 6, 440), light, dark, smoothstep(0.56, 0.66, patches));
}
