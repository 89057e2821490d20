// The texture of gravel, made once: it repeats after one unit.

layout(location = 0) out vec4 gravel;  // slope along x, y; height; shade

const float kSize = 1024.0;  // texels on a side

// Pebbles of three sizes half sunk in earth. x: height; y: shade, 0 for earth.
vec2 gravel_at(vec2 uv) {
  vec2 warped = uv + 0.014 * vec2(cloud(uv, 36, 4, 300), cloud(uv, 36, 4, 310));
  vec2 p = vec2(0.004 * cloud(uv, 48, 5, 340), 0.0);
  vec2 sizes[3] = vec2[](pebbles(warped, 25, 0.18, 320), pebbles(warped, 57, 0.34, 330),
                         pebbles(uv, 120, 0.5, 335));
  for (int i = 0; i < 3; ++i)
    if (sizes[i].x > p.x) p = sizes[i];
  return vec2(p.x * 54.0, p.y);
}

void main() {
  vec2 ground = gravel_at(gl_FragCoord.xy / kSize);
  // Slopes are stored around 1/2; 1 stands for the largest, as named in stones.glsl.
  vec2 rise = vec2(dFdxFine(ground.x), dFdyFine(ground.x));
  gravel = vec4(0.5 + 0.5 * rise * kSize / 64.0, ground);
}
