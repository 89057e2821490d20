// Noise that repeats after one unit, for textures that are made once.

// Integers wrapped into [0, period). Whole numbers are divided one by one on software rasterizers.
ivec2 wrapped(vec2 cell, vec2 period) {
  return ivec2(cell - period * floor((cell + 0.5) / period));
}

// Value noise in [0, 1] on a lattice that repeats after `period` cells.
float noise(vec2 p, int period, int what) {
  vec2 cell = floor(p);
  vec2 f = p - cell;
  f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  ivec2 low = wrapped(cell, vec2(period));
  ivec2 high = wrapped(cell + 1.0, vec2(period));
  float a = random(low, what).x;
  float b = random(ivec2(high.x, low.y), what).x;
  float c = random(ivec2(low.x, high.y), what).x;
  float d = random(high, what).x;
  return mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
}

// The same with a period for each axis.
float noise(vec2 p, ivec2 period, int what) {
  vec2 cell = floor(p);
  vec2 f = p - cell;
  f = f * f * (3.0 - 2.0 * f);
  ivec2 low = wrapped(cell, vec2(period));
  ivec2 high = wrapped(cell + 1.0, vec2(period));
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
  vec2 home = floor(p);
  vec4 found = vec4(9.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec2 cell = home + vec2(x, y);
      vec3 chance = random(wrapped(cell, vec2(period)), what);
      float d = distance(p, cell + 0.1 + 0.8 * chance.xy);
      if (d < found.x) found = vec4(d, found.x, chance.z, fract(97.0 * chance.z));
      else if (d < found.y) found.y = d;
    }
  return found;
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
