// The textures of stone and ground, made once: they repeat after one unit.

layout(location = 0) out vec4 stone_relief;   // slope along x, y; height; crack
layout(location = 1) out vec4 stone_color;    // mottling, light grains, dark grains, lichen
layout(location = 2) out vec4 gravel;         // slope along x, y; height; shade

const float kSize = 1024.0;  // texels on a side

// Value noise in [0, 1] on a lattice that repeats after `period` cells.
float noise(vec2 p, int period, int what) {
  ivec2 cell = ivec2(floor(p));
  vec2 f = p - vec2(cell);
  f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  ivec2 low = (cell + 64 * period) % period;
  ivec2 high = (low + 1) % period;
  float a = random(low, what).x;
  float b = random(ivec2(high.x, low.y), what).x;
  float c = random(ivec2(low.x, high.y), what).x;
  float d = random(high, what).x;
  return mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
}

// Octaves of noise from `period` cells on, each half as strong as the one before; in [0, 1].
float cloud(vec2 uv, int period, int octaves, int what) {
  float sum = 0.0, strength = 0.5, total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * noise(uv * float(period), period, what + i);
    total += strength;
    strength *= 0.5;
    period *= 2;
  }
  return sum / total;
}

// Distances to the nearest and second nearest of one point per cell; z, w: chance of the nearest.
vec4 cells(vec2 uv, int period, int what) {
  vec2 p = uv * float(period);
  ivec2 home = ivec2(floor(p));
  vec4 found = vec4(9.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 cell = home + ivec2(x, y);
      vec3 chance = random((cell + 64 * period) % period, what);
      float d = distance(p, vec2(cell) + 0.1 + 0.8 * chance.xy);
      if (d < found.x) found = vec4(d, found.x, chance.z, fract(97.0 * chance.z));
      else if (d < found.y) found.y = d;
    }
  return found;
}

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

// One class of pebbles: `share` of the cells hold one. x: height; y: its shade.
vec2 pebbles(vec2 uv, int period, float share, int what) {
  vec4 c = cells(uv, period, what);
  // Blunt polygons inside their cell, some much smaller than it.
  float inside = c.y - c.x - (0.1 + 0.4 * fract(61.0 * c.w));
  if (c.z >= share || inside <= 0.0) return vec2(0.0);
  float height = 0.5 * sqrt(1.0 - pow(1.0 - min(inside / 0.6, 1.0), 2.0));
  return vec2(height / float(period), 0.2 + 0.8 * c.w);
}

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
  vec2 uv = gl_FragCoord.xy / kSize;

  // Slopes are stored around 1/2; 1 stands for the largest, as named in picture.frag.
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

  vec2 ground = gravel_at(uv);
  vec2 rise = vec2(dFdxFine(ground.x), dFdyFine(ground.x));
  gravel = vec4(0.5 + 0.5 * rise * kSize / 64.0, ground);
}
