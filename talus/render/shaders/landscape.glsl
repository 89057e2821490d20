// Ground of many materials, each with its texture, blended by their shares and heights.

struct Surface {
  // Four textures: for what faces up and aside, from near; likewise for the large scales.
  vec4 tints[4];  // the color asked for over the texture's mean; w: metres after which it repeats
  vec4 layers;
  vec4 phases[6];  // of the eye in the texture at each scale; w: change of color over the land
};
layout(std140, binding = 1) uniform Surfaces {
  vec4 cloud_phases[3];  // of the eye; w: metres after which clouds repeat
  Surface surfaces[8];
};
layout(binding = 7) uniform sampler2DArray surface_colors;   // share of light reflected; height
layout(binding = 8) uniform sampler2DArray surface_reliefs;  // slopes, roughness, hollows
layout(binding = 9) uniform sampler2D clouds;

const float kTexels = 512.0;
const float kCloudTexels = 512.0;
const float kSlopeLimit = 4.0;
const int kScales = 6;  // of a texture, each 8 times larger than the one before
const float kBlend = 12.0;  // how sharply the higher material prevails

// A turn by a rational angle: five periods of the texture become whole periods again.
const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8);

// `times` smaller than at the scale: a whole number, so that a phase stays one.
vec4 clouds_at(int scale, float times, vec3 from_eye, float footprint) {
  float size = cloud_phases[scale].w / times;
  vec3 at = from_eye / size + times * cloud_phases[scale].xyz;
  // Also on walls, where x and y hardly change.
  vec2 uv = at.xy + at.z * vec2(1.0, -1.0);
  return textureLod(clouds, uv, log2(max(footprint * kCloudTexels / size, 1e-4)));
}

// Beds of rock across all the scene, a little tilted and bent: light and dark ones.
float beds_at(int scale, vec3 from_eye, float footprint, vec2 bend) {
  float size = cloud_phases[scale].w;
  vec3 at = from_eye / size + cloud_phases[scale].xyz;
  vec2 uv = vec2(at.x + at.y, 8.0 * (at.z + 0.05 * at.x - 0.025 * at.y)) + bend;
  return textureLod(clouds, uv, log2(max(8.0 * footprint * kCloudTexels / size, 1e-4)) - 1.0).x;
}

// `from_eye` in metres; `footprint`: metres that a sample spans on the surface.
Material landscape_material(vec3 from_eye, vec3 n, vec4 low, vec4 high, float footprint) {
  vec3 planes = projection_weights(n, 8.0);
  vec4 near_clouds = clouds_at(0, 1.0, from_eye, footprint);
  vec4 far_clouds = clouds_at(1, 1.0, from_eye, footprint);
  vec4 wide_clouds = clouds_at(2, 1.0, from_eye, footprint);
  vec2 bend = 0.5 * (far_clouds.zw - 0.5);
  float beds = 0.40 * beds_at(0, from_eye, footprint, bend + 0.25 * near_clouds.zw) +
               0.35 * beds_at(1, from_eye, footprint, bend) +
               0.25 * beds_at(2, from_eye, footprint, 0.3 * bend);
  vec3 variation =
      3.0 * (0.35 * near_clouds.xyz + 0.35 * far_clouds.xyz + 0.3 * wide_clouds.xyz - 0.5);

  uint shown = 0u;
  for (int i = 0; i < 8; ++i) shown |= (i < 4 ? low[i & 3] : high[i & 3]) > 0.004 ? 1u << i : 0u;
  uint sides = faced_sides(planes);

  vec3 albedo = vec3(0.0);
  vec3 gradient = vec3(0.0);
  float roughness = 0.0;
  float total = 0.0;
  for (; shown != 0u; shown &= shown - 1u) {
    int i = findLSB(shown);
    float share = i < 4 ? low[i & 3] : high[i & 3];
    // The two scales between whose texels a sample's size lies.
    float level = log2(max(footprint * kTexels / surfaces[i].tints[0].w, 1e-4));
    float place = clamp((level - 1.0) / 3.0, 0.0, float(kScales) - 1.001);
    int scale = int(place);
    float toward_next = smoothstep(0.3, 0.7, place - float(scale));

    vec4 color = vec4(0.0);
    vec4 relief = vec4(0.0);
    vec3 slopes = vec3(0.0);
    uint reads = (toward_next < 1.0 ? sides : 0u) | (toward_next > 0.0 ? sides << 3u : 0u);
    for (; reads != 0u; reads &= reads - 1u) {
      int read = findLSB(reads);
      int axis = read < 3 ? read : read - 3;
      int n_scale = read < 3 ? scale : scale + 1;
      float weight = planes[axis] * (read < 3 ? 1.0 - toward_next : toward_next);
      int use = (axis == 2 ? 0 : 1) + (n_scale > 0 ? 2 : 0);
      float size = surfaces[i].tints[0].w * exp2(3.0 * float(n_scale));
      vec3 at = from_eye / size + surfaces[i].phases[n_scale].xyz;
      mat2 turn = axis == 2 && (n_scale & 1) == 1 ? kTurn : mat2(1.0);
      vec2 plan = axis == 0 ? at.yz : axis == 1 ? at.xz : at.xy;
      vec3 uv = vec3(turn * plan + 0.37 * float(axis + n_scale), surfaces[i].layers[use]);
      float lod = level - 3.0 * float(n_scale);
      // Colors are kept as square roots.
      vec4 c = textureLod(surface_colors, uv, lod);
      color += weight * vec4(c.rgb * c.rgb * surfaces[i].tints[use].rgb, c.a);
      vec4 r = textureLod(surface_reliefs, uv, lod);
      relief += weight * r;
      vec2 slope = (weight * exp2(-0.35 * float(n_scale))) * (r.xy - 0.5) * turn;
      slopes += axis == 0 ? vec3(0.0, slope) : axis == 1 ? vec3(slope.x, 0.0, slope.y)
                                                         : vec3(slope, 0.0);
    }

    vec3 tinted = color.rgb * (0.55 + 0.9 * relief.w);
    float variety = surfaces[i].phases[0].w;
    tinted *= max(1.0 + variety * (0.55 * variation.x + vec3(0.10, 0.0, -0.12) * variation.y), 0.1);
    if (variety == 1.0) {  // rock
      float light = smoothstep(0.38, 0.62, beds);
      tinted *= mix(vec3(0.80, 0.70, 0.60), vec3(1.16, 1.15, 1.12), light);
      // Seen from afar, what lies flat is weathered and grown over.
      float grown =
          smoothstep(0.72, 0.93, n.z + 0.10 * variation.z) * smoothstep(1.0, 8.0, footprint);
      tinted *= mix(vec3(1.0), vec3(0.62, 0.66, 0.50), grown);
    }
    float weight = share * exp(kBlend * (color.a - 0.5));
    albedo += weight * tinted;
    gradient += (weight * 2.0 * kSlopeLimit) * slopes;
    roughness += weight * relief.z;
    total += weight;
  }
  total = max(total, 1e-6);
  gradient /= total;
  roughness /= total;

  Material m;
  m.albedo = clamp(albedo / total, 0.0, 0.92);
  m.normal = normalize(n - (gradient - n * dot(gradient, n)));
  m.gloss = mix(6.0, 0.3, smoothstep(0.1, 0.8, roughness));
  m.gloss_power = mix(160.0, 14.0, smoothstep(0.1, 0.7, roughness));
  return m;
}
