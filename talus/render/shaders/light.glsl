// Sun, sky, and what they make of a material.

layout(binding = 3) uniform sampler2DArrayShadow sun_maps;

struct Material {
  vec3 albedo;
  vec3 normal;
  float gloss;
  float gloss_power;
};

vec3 sun_color() {
  float height = frame.sun.z;
  return 3.1 * mix(vec3(1.0, 0.55, 0.26), vec3(1.0, 0.89, 0.73), smoothstep(0.0, 0.6, height));
}

#ifdef LANDSCAPE

// What air adds on the way: the color of the sky low above the horizon, brighter toward the sun.
vec3 haze(vec3 direction) {
  float day = smoothstep(0.05, 0.5, frame.sun.z);
  vec2 sun = normalize(frame.sun.xy + 1e-5);
  float toward = 0.5 + 0.5 * clamp(dot(normalize(direction.xy + 1e-5), sun), -1.0, 1.0);
  vec3 pale = mix(vec3(0.80, 0.66, 0.54), vec3(0.60, 0.72, 0.86), day);
  return pale + 0.05 * sun_color() * pow(toward, 6.0);
}

// Sky in a direction: pale at the horizon, deep above, bright around the sun. Below the horizon,
// far land in haze.
vec3 sky(vec3 direction) {
  float height = max(direction.z, 0.0);
  vec3 blue = vec3(0.20, 0.40, 0.74);
  vec3 zenith = vec3(0.07, 0.19, 0.48);
  vec3 clear = mix(mix(haze(direction), blue, 1.0 - exp(-6.5 * height)), zenith,
                   smoothstep(0.0, 0.85, height));
  vec3 land = vec3(0.36, 0.40, 0.44);
  clear = mix(clear, land, 0.85 * (1.0 - exp(3.0 * min(direction.z, 0.0))));
  float toward = max(dot(direction, frame.sun.xyz), 0.0);
  return clear + sun_color() * (0.03 * pow(toward, 6.0) + 0.10 * pow(toward, 60.0) +
                                12.0 * smoothstep(0.99985, 0.99995, toward));
}

// Light that walls in the sun throw back.
vec3 fill_light() { return vec3(0.80, 0.64, 0.47) * (0.25 + 0.75 * frame.sun.z); }

#else

// Sky in a direction: pale at the horizon, deep above, bright around the sun.
vec3 sky(vec3 direction) {
  float height = max(direction.z, 0.0);
  float day = smoothstep(0.05, 0.5, frame.sun.z);
  vec3 haze = mix(vec3(0.84, 0.74, 0.64), vec3(0.80, 0.82, 0.82), day);
  vec3 blue = vec3(0.21, 0.38, 0.66);
  vec3 zenith = vec3(0.10, 0.20, 0.44);
  vec3 clear = mix(mix(haze, blue, 1.0 - exp(-8.0 * height)), zenith, smoothstep(0.0, 0.9, height));
  float toward = max(dot(direction, frame.sun.xyz), 0.0);
  return clear + sun_color() * (0.035 * pow(toward, 5.0) + 0.08 * pow(toward, 48.0));
}

#endif

// Share of the sun that a surface sees: a disk of comparisons, turned anew at each sample, in the
// finest map that shows the place.
float sunlight(vec3 p, vec3 normal, ivec2 texel) {
  float sine = sqrt(max(1.0 - pow(dot(normal, frame.sun.xyz), 2.0), 0.0));
  int maps = int(frame.sun.w);
  int map = maps - 1;
  vec3 at = vec3(0.0);
  for (int i = maps - 1; i >= 0; --i) {
    float texel_size = frame.sun_texels[i];
    vec3 there = (frame.sun_from_view[i] *
                  vec4(p + normal * texel_size * (0.7 + 3.0 * sine), 1.0)).xyz;
    bool shown = all(lessThan(abs(there.xy - 0.5), vec2(0.497)));
    if (shown || i == maps - 1) {
      map = i;
      at = there;
    }
  }
  // Beyond the last thing that casts a shadow only its shadow ends the light, not the map.
  at.z = max(at.z, 1e-6);
  float turn = 6.2831853 * random(texel, 1).x;
  float lit = 0.0;
  const int kTaps = 8;
  for (int i = 0; i < kTaps; ++i) {
    float angle = turn + 2.39996323 * float(i);
    float radius = 2.2 * sqrt((float(i) + 0.5) / float(kTaps));
    vec2 offset = radius * vec2(cos(angle), sin(angle)) / vec2(textureSize(sun_maps, 0).xy);
    lit += texture(sun_maps, vec4(at.xy + offset, float(map), at.z));
  }
  return lit / float(kTaps);
}

// Light that reaches a crevice after bouncing off its own walls ([Jimenez2016], eq. 10).
vec3 many_bounces(float visibility, vec3 albedo) {
  vec3 a = 2.0404 * albedo - 0.3324;
  vec3 b = -4.7951 * albedo + 0.6417;
  vec3 c = 2.7552 * albedo + 0.6903;
  return max(vec3(visibility), ((visibility * a + b) * visibility + c) * visibility);
}

// Light of the sky and of the sunlit earth on a surface. `open`: the share of the sky that is seen,
// how open the place is whatever the surface faces, and what is not hidden by things near by.
vec3 ambient(vec3 normal, vec3 open, vec3 albedo) {
  vec3 sky = vec3(0.44, 0.53, 0.70);
  vec3 earth = vec3(0.27, 0.21, 0.15) * (0.35 + 0.65 * frame.sun.z);
#ifdef LANDSCAPE
  sky *= 1.15;
  earth *= 1.3 * smoothstep(0.0, 0.5, open.y);
#endif
  float up = 0.5 + 0.5 * normal.z;
  return up * sky * many_bounces(open.x, albedo) +
         (1.0 - up) * earth * many_bounces(open.z, albedo);
}

// Film's shoulder and toe: fit of the ACES reference transforms ([Hill2017]), then sRGB.
vec3 tone(vec3 light) {
  const mat3 kInput = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566,
                           0.83777);
  const mat3 kOutput = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367,
                            -0.00605, 1.07602);
  vec3 v = kInput * light;
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  v = clamp(kOutput * v, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
}
