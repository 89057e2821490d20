// A material's texture, made once: it repeats after one unit. PATTERN says which material.

layout(location = 0) out vec4 color_height;      // root of the share of light reflected; height
layout(location = 1) out vec2 relief_roughness;  // height in units of the texture's width

const float kSize = 512.0;  // texels on a side

struct Texel {
  vec3 color;
  float height;
  float relief;  // what the height counts in widths
  float roughness;
};

float grain(vec2 uv, int what) { return cloud(uv, 180, 2, what) - 0.5; }

// Part of a ragged blot around some points.
float blots(vec2 uv, int period, float share, int what) {
  vec2 ragged = uv + (0.35 / float(period)) * (vec2(cloud(uv, 4 * period, 3, what + 1),
                                                    cloud(uv, 4 * period, 3, what + 5)) - 0.5);
  vec4 c = cells(ragged, period, what);
  float radius = 0.12 + 0.3 * c.w;
  return step(c.z, share) * smoothstep(radius, 0.7 * radius, c.x);
}

// Cracks between warped cells, some of them.
float cracks(vec2 uv, int period, float width, int what) {
  vec2 warped = uv + (0.5 / float(period)) * (vec2(cloud(uv, 2 * period, 4, what + 1),
                                                   cloud(uv, 2 * period, 4, what + 6)) - 0.5);
  vec4 c = cells(warped, period, what);
  float broken = smoothstep(0.42, 0.56, cloud(uv, period + 1, 3, what + 11));
  return broken * (1.0 - smoothstep(0.0, width, c.y - c.x));
}

Texel plain(vec2 uv) { return Texel(vec3(1.0), 0.5, 0.0, 0.9); }

// Rock from the side: beds of uneven thickness, broken into blocks by joints.
Texel cliff(vec2 uv) {
  const ivec2 kBlocks = ivec2(5, 9);
  vec2 bend = vec2(cloud(uv, 4, 5, 10), cloud(uv, 3, 5, 20)) - 0.5;
  vec2 w = uv + vec2(0.07, 0.05) * bend;
  float b = w.y * float(kBlocks.y) + 1.3 * noise(w * vec2(1.0, 9.0), ivec2(1, 9), 30);
  int bed = wrapped(vec2(floor(b)), vec2(kBlocks.y)).x;
  float up = fract(b);
  vec3 bed_chance = random(ivec2(bed, 3), 40);
  float a = w.x * float(kBlocks.x) + 5.0 * bed_chance.y + 0.5 * (cloud(uv, 9, 3, 50) - 0.5);
  ivec2 block = ivec2(wrapped(vec2(floor(a)), vec2(kBlocks.x)).x, bed);
  float along = fract(a);
  vec3 block_chance = random(block, 60);

  // Edges of beds and blocks are worn away in places.
  float worn = smoothstep(0.36, 0.60, cloud(uv, 8, 4, 65));
  float bed_edge = mix(1.0, smoothstep(0.0, 0.16, up) * smoothstep(0.0, 0.30, 1.0 - up), worn);
  float joint = block_chance.y > 0.5 ? smoothstep(0.0, 0.06, min(along, 1.0 - along)) : 1.0;
  joint = mix(1.0, joint, worn);
  float thin_beds = noise(w * vec2(5.0, 72.0), ivec2(5, 72), 70);
  float lumps = cloud(uv, 10, 6, 80);
  float crack = cracks(uv, 6, 0.02, 90);

  Texel t;
  t.height = 0.30 * bed_chance.x + 0.22 * block_chance.x;
  t.height = t.height * (0.55 + 0.45 * bed_edge * joint) + 0.10 * bed_edge * joint;
  t.height += 0.13 * thin_beds * (0.4 + 0.6 * bed_chance.z) + 0.34 * lumps - 0.05 * crack;
  t.relief = 0.034;
  float stain = smoothstep(0.52, 0.72, cloud(uv, 3, 6, 120));
  float streak = noise(uv * vec2(40.0, 3.0) + bend, ivec2(40, 3), 130) *
                 noise(uv * vec2(13.0, 2.0), ivec2(13, 2), 135);
  t.color = mix(vec3(0.86, 0.80, 0.73), vec3(1.08, 1.06, 1.02), bed_chance.x);
  t.color *= (0.78 + 0.44 * lumps) * (0.90 + 0.20 * block_chance.z) * (0.93 + 0.14 * thin_beds);
  t.color = mix(t.color, t.color * vec3(1.08, 0.80, 0.58), 0.55 * stain);
  t.color *= 1.0 - 0.38 * smoothstep(0.25, 0.6, streak);
  t.color *= 1.0 + 0.35 * grain(uv, 140);
  t.color *= mix(0.80, 1.0, bed_edge) * mix(0.80, 1.0, joint) * (1.0 - 0.2 * crack);
  t.roughness = 0.85;
  return t;
}

// The same from afar: beds alone.
Texel wall(vec2 uv) {
  const float kBeds = 11.0;
  vec2 bend = vec2(cloud(uv, 4, 5, 15), cloud(uv, 3, 5, 25)) - 0.5;
  vec2 w = uv + vec2(0.08, 0.07) * bend;
  float b = w.y * kBeds + 1.6 * noise(w * vec2(1.0, 11.0), ivec2(1, 11), 35);
  vec3 chance = random(wrapped(vec2(floor(b)), vec2(kBeds)), 45);
  vec3 above = random(wrapped(vec2(floor(b) + 1.0), vec2(kBeds)), 45);
  chance = mix(chance, above, smoothstep(0.75, 1.0, fract(b)));
  float thin_beds = noise(w * vec2(5.0, 64.0), ivec2(5, 64), 75);
  float lumps = cloud(uv, 7, 7, 85);
  float gullies = abs(noise((uv + 0.1 * bend) * vec2(17.0, 3.0), ivec2(17, 3), 95) - 0.5) * 2.0;

  Texel t;
  t.height = 0.28 * chance.x + 0.12 * thin_beds + 0.45 * lumps + 0.10 * gullies;
  t.relief = 0.040;
  t.color = mix(vec3(0.84, 0.78, 0.71), vec3(1.10, 1.07, 1.02), chance.x);
  t.color *= (0.74 + 0.52 * lumps) * (0.92 + 0.16 * thin_beds) * (0.88 + 0.18 * gullies);
  t.color = mix(t.color, t.color * vec3(1.08, 0.82, 0.62),
                0.5 * smoothstep(0.5, 0.7, cloud(uv, 3, 6, 125)));
  t.color *= 1.0 + 0.3 * grain(uv, 145);
  t.roughness = 0.9;
  return t;
}

// Rock from above: cracked, pitted, with lichen and grit.
Texel slab(vec2 uv) {
  float lumps = cloud(uv, 6, 7, 200);
  float crack = max(cracks(uv, 4, 0.045, 210), 0.8 * cracks(uv, 9, 0.05, 230));
  float pits = smoothstep(0.58, 0.72, cloud(uv, 36, 3, 250));
  float pale = blots(uv, 17, 0.32, 260) * (0.5 + cloud(uv, 60, 3, 265));
  float rusty = blots(uv, 26, 0.10, 270);
  vec2 grit = pebbles(uv, 70, 0.16, 280);

  Texel t;
  t.height = 0.75 * lumps - 0.10 * pits - 0.26 * crack + 8.0 * grit.x;
  t.relief = 0.05;
  t.color = vec3(0.98, 0.95, 0.90) * (0.62 + 0.76 * lumps) * (1.0 + 0.4 * grain(uv, 290));
  t.color = mix(t.color, vec3(1.25, 1.30, 1.05), 0.5 * clamp(pale, 0.0, 1.0));
  t.color = mix(t.color, vec3(1.15, 0.72, 0.30), 0.55 * rusty);
  t.color = mix(t.color, vec3(0.9) * (0.6 + 0.7 * grit.y), 0.7 * step(1e-5, grit.x));
  t.color *= (1.0 - 0.6 * crack) * (1.0 - 0.25 * pits);
  t.roughness = 0.85;
  return t;
}

// The same from afar: ribs and hollows.
Texel massif(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 4, 5, 205), cloud(uv, 5, 5, 215)) - 0.5;
  float ribs = 1.0 - abs(2.0 * cloud(uv + 0.08 * bend, 6, 7, 225) - 1.0);
  float lumps = cloud(uv, 9, 7, 235);
  float debris = smoothstep(0.48, 0.62, cloud(uv + 0.06 * bend, 7, 6, 245));

  Texel t;
  t.height = 0.45 * ribs + 0.40 * lumps;
  t.relief = 0.055;
  t.color =
      vec3(0.98, 0.95, 0.90) * (0.60 + 0.42 * lumps + 0.38 * ribs) * (1.0 + 0.35 * grain(uv, 255));
  t.color = mix(t.color, vec3(1.02, 0.93, 0.80) * (0.75 + 0.5 * lumps), 0.55 * debris);
  t.roughness = 0.9;
  return t;
}

// Ripples of the wind with forks and fading, fine grain, some dark grains.
Texel sand(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 3, 4, 300), cloud(uv, 4, 4, 310)) - 0.5;
  float phase = 13.0 * uv.y + 3.4 * bend.x + 0.9 * (cloud(uv, 9, 3, 320) - 0.5);
  float along = fract(phase);
  // The windward side is longer than the lee.
  float ripple = along < 0.68 ? 0.5 - 0.5 * cos(along * 3.14159 / 0.68)
                              : 0.5 + 0.5 * cos((along - 0.68) * 3.14159 / 0.32);
  float strength = smoothstep(0.28, 0.62, cloud(uv + 0.1 * bend, 4, 3, 330));
  float dunes = cloud(uv, 3, 4, 340);

  Texel t;
  t.height = 0.42 * ripple * strength + 0.5 * dunes + 0.05 * grain(uv, 350);
  t.relief = 0.020;
  t.color = vec3(1.0, 0.985, 0.96) * (0.90 + 0.16 * ripple * strength + 0.10 * (dunes - 0.5));
  t.color *= 1.0 + 0.35 * grain(uv, 360) + 0.20 * (cloud(uv, 110, 2, 370) - 0.5);
  vec4 speck = cells(uv, 150, 380);
  t.color *= 1.0 - 0.35 * step(speck.z, 0.12) * (1.0 - smoothstep(0.2, 0.4, speck.x));
  t.roughness = 0.95;
  return t;
}

// Earth with stones, under patches of short grass, green and withered.
Texel soil(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 12, 4, 400), cloud(uv, 12, 4, 410)) - 0.5;
  float lumps = cloud(uv, 14, 6, 420);
  vec2 stones = pebbles(uv + 0.02 * bend, 38, 0.14, 430);
  vec2 grit = pebbles(uv, 90, 0.25, 440);
  float cover = smoothstep(0.40, 0.56, cloud(uv + 0.05 * bend, 5, 6, 450));
  float tuft = cloud(uv + 0.02 * bend, 30, 3, 460);

  // Blades lean two ways.
  vec2 lean = uv + 0.03 * bend;
  float blades =
      max(noise(lean * vec2(210.0, 60.0), ivec2(210, 60), 470),
          noise((lean + lean.yx * vec2(1.0, 0.0)) * vec2(180.0, 70.0), ivec2(180, 70), 480));
  float dry = smoothstep(0.44, 0.66, cloud(uv + 0.04 * bend, 7, 4, 490));
  vec3 grass = mix(vec3(0.70, 0.78, 0.34), vec3(1.40, 1.16, 0.66), dry);
  grass *= (0.35 + 0.95 * blades) * (0.6 + 0.8 * tuft);
  vec3 earth =
      mix(vec3(0.80, 0.62, 0.44), vec3(1.45, 1.18, 0.88), lumps) * (1.0 + 0.5 * grain(uv, 500));
  earth = mix(earth, vec3(1.7, 1.62, 1.5) * (0.4 + 0.8 * stones.y), 0.9 * step(1e-5, stones.x));
  earth = mix(earth, vec3(1.6, 1.45, 1.25) * (0.4 + 0.7 * grit.y), 0.7 * step(1e-5, grit.x));

  Texel t;
  t.height = 0.35 * lumps + 9.0 * stones.x + 8.0 * grit.x;
  t.height = mix(t.height, 0.30 + 0.35 * tuft + 0.22 * blades, cover);
  t.relief = mix(0.04, 0.026, cover);
  t.color = mix(earth, grass, cover);
  t.roughness = 0.95;
  return t;
}

// The same from afar: patches of grass, bare earth, a few blocks.
Texel meadow(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 12, 4, 405), cloud(uv, 12, 4, 415)) - 0.5;
  float lumps = cloud(uv, 9, 7, 425);
  float cover = smoothstep(0.36, 0.50, cloud(uv + 0.05 * bend, 6, 7, 455));
  float tuft = cloud(uv, 40, 4, 465);
  float dry = smoothstep(0.40, 0.66, cloud(uv + 0.05 * bend, 5, 7, 495));
  vec3 grass = mix(vec3(0.66, 0.74, 0.33), vec3(1.30, 1.10, 0.64), dry) * (0.62 + 0.76 * tuft);
  vec3 earth =
      mix(vec3(0.95, 0.76, 0.55), vec3(1.45, 1.20, 0.92), lumps) * (1.0 + 0.4 * grain(uv, 505));
  float shrubs = blots(uv, 34, 0.16, 515) * cover;

  Texel t;
  t.height = mix(0.30 * lumps + 0.1, 0.30 + 0.40 * lumps + 0.15 * tuft, cover) + 0.2 * shrubs;
  t.relief = 0.022;
  t.color = mix(earth, grass, cover) * (1.0 - 0.45 * shrubs);
  t.roughness = 0.95;
  return t;
}

// Sand from afar: low waves.
Texel dunes(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 3, 4, 305), cloud(uv, 4, 4, 315)) - 0.5;
  float wave = cloud(uv + 0.1 * bend, 4, 6, 325);
  float fine = cloud(uv * vec2(1.0, 1.0) + 0.05 * bend, 24, 4, 335);

  Texel t;
  t.height = 0.7 * wave + 0.15 * fine;
  t.relief = 0.020;
  t.color = vec3(1.0, 0.985, 0.96) * (0.86 + 0.22 * wave + 0.10 * (fine - 0.5)) *
            (1.0 + 0.12 * grain(uv, 365));
  t.roughness = 0.95;
  return t;
}

// Gravel from afar: mottled.
Texel scree(vec2 uv) {
  float lumps = cloud(uv, 8, 7, 535);
  vec2 p = pebbles(uv, 90, 0.6, 565);

  Texel t;
  t.height = 0.6 * lumps + 20.0 * p.x;
  t.relief = 0.03;
  t.color =
      mix(vec3(0.75, 0.70, 0.64), vec3(1.25, 1.18, 1.08), lumps) * (1.0 + 0.5 * grain(uv, 585));
  t.color = mix(t.color, vec3(1.2, 1.12, 1.0) * (0.5 + 0.7 * p.y), 0.5 * step(1e-5, p.x));
  t.roughness = 0.9;
  return t;
}

// Pebbles of three sizes in earth.
Texel gravel(vec2 uv) {
  vec2 warped = uv + 0.014 * (vec2(cloud(uv, 36, 4, 510), cloud(uv, 36, 4, 520)) - 0.5);
  float lumps = cloud(uv, 30, 5, 530);
  vec2 p = vec2(0.006 * lumps, 0.0);
  vec2 sizes[4] = vec2[](pebbles(warped, 19, 0.34, 540), pebbles(warped, 37, 0.55, 550),
                         pebbles(uv, 71, 0.7, 560), pebbles(uv + 0.37, 110, 0.8, 570));
  for (int i = 0; i < 4; ++i)
    if (sizes[i].x > p.x) p = sizes[i];

  Texel t;
  t.height = clamp(34.0 * p.x, 0.0, 1.0);
  t.relief = 0.03;
  vec3 stone = mix(vec3(0.62, 0.60, 0.60), vec3(1.5, 1.38, 1.2), p.y) * (0.8 + 0.4 * lumps);
  t.color = mix(vec3(0.52, 0.45, 0.37) * (0.6 + 0.8 * lumps), stone, step(1e-4, p.y));
  t.color *= (1.0 + 0.3 * grain(uv, 580)) * (0.7 + 0.4 * t.height);
  t.roughness = 0.9;
  return t;
}

// Wind-pressed snow: soft drifts, faint ripples.
Texel snow(vec2 uv) {
  vec2 bend = vec2(cloud(uv, 3, 4, 600), cloud(uv, 4, 4, 610)) - 0.5;
  float drifts = cloud(uv + 0.1 * bend, 3, 5, 620);
  float ridges = noise((uv + 0.12 * bend) * vec2(6.0, 26.0), ivec2(6, 26), 630);

  Texel t;
  t.height = 0.75 * drifts + 0.12 * ridges + 0.03 * grain(uv, 640);
  t.relief = 0.028;
  t.color = mix(vec3(0.93, 0.97, 1.03), vec3(1.02, 1.01, 0.99), smoothstep(0.3, 0.65, drifts));
  t.color *= 0.97 + 0.05 * ridges + 0.05 * grain(uv, 650);
  t.roughness = 0.75;
  return t;
}

// Ice: clear and clouded parts, white cracks of two sizes, frost.
Texel ice(vec2 uv) {
  float depth = cloud(uv, 3, 6, 700);
  float crack = max(cracks(uv, 4, 0.02, 710), 0.6 * cracks(uv, 11, 0.025, 730));
  float halo = max(cracks(uv, 4, 0.16, 710), 0.4 * cracks(uv, 11, 0.16, 730));
  float frost = smoothstep(0.5, 0.75, cloud(uv, 6, 6, 750));
  float bubbles = blots(uv, 60, 0.12, 760);

  Texel t;
  t.height = 0.4 * depth + 0.15 * frost - 0.12 * crack + 0.2;
  t.relief = 0.012;
  t.color = mix(vec3(0.42, 0.72, 0.86), vec3(1.05, 1.08, 1.06), smoothstep(0.25, 0.75, depth));
  t.color = mix(t.color, vec3(1.7, 1.42, 1.32), 0.30 * halo + 0.55 * crack);
  t.color = mix(t.color, vec3(1.75, 1.45, 1.36), 0.55 * frost);
  t.color = mix(t.color, vec3(1.6, 1.38, 1.3), 0.4 * bubbles);
  t.roughness = mix(0.12, 0.6, frost);
  return t;
}

void main() {
  vec2 uv = gl_FragCoord.xy / kSize;
  Texel t = PATTERN(uv);
  // Dark enough for the brightest texel of a pale material; the mean is set later.
  color_height = vec4(sqrt(0.45 * t.color), clamp(t.height, 0.0, 1.0));
  relief_roughness = vec2(t.relief * t.height, t.roughness);
}
