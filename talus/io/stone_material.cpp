#include "talus/io/stone_material.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "talus/base/noise.h"
#include "talus/base/parallel.h"
#include "talus/base/vec.h"

namespace talus {
namespace {

constexpr int kSize = 512;
constexpr float kRelief = 11.0f;  // slope of the normal map for a height difference of one pixel

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}
Vec3f mix(const Vec3f& a, const Vec3f& b, float t) { return a + t * (b - a); }

// Octaves of noise, each of twice the frequency and `gain` times the height of the one before.
class Octaves {
 public:
  Octaves(std::uint64_t seed, int period, int count, float gain) : gain_(gain) {
    for (int i = 0; i < count; ++i) noises_.emplace_back(seed, period << i);
    for (int i = 0; i < count; ++i) frequencies_.push_back(static_cast<float>(period << i));
  }
  float operator()(float u, float v) const {
    float sum = 0, height = 1;
    for (std::size_t i = 0; i < noises_.size(); ++i) {
      sum += height * noises_[i](u * frequencies_[i], v * frequencies_[i]);
      height *= gain_;
    }
    return sum;
  }

 private:
  float gain_;
  std::vector<PeriodicNoise> noises_;
  std::vector<float> frequencies_;
};

// A square of numbers whose edges meet.
class Field2 {
 public:
  Field2() : values_(static_cast<std::size_t>(kSize) * kSize) {}
  float& at(int x, int y) { return values_[index(x, y)]; }
  float at(int x, int y) const { return values_[index(x, y)]; }

 private:
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>((y & (kSize - 1)) * kSize + (x & (kSize - 1)));
  }
  std::vector<float> values_;
};

// Mean over a square of 2 r + 1 pixels, separably.
Field2 blurred(const Field2& field, int r) {
  Field2 rows, out;
  const float share = 1 / static_cast<float>(2 * r + 1);
  const auto pass = [&](const Field2& from, Field2& to, int dx, int dy) {
    parallel_for(kSize, [&](std::size_t row) {
      for (int x = 0, y = static_cast<int>(row); x < kSize; ++x) {
        float sum = 0;
        for (int k = -r; k <= r; ++k) sum += from.at(x + k * dx, y + k * dy);
        to.at(x, y) = sum * share;
      }
    });
  };
  pass(field, rows, 1, 0);
  pass(rows, out, 0, 1);
  return out;
}

// Mineral grains, weathered pits and a few cracks on a broken surface.
Field2 make_heights(std::uint64_t seed) {
  const Octaves shape(seed, 3, 8, 0.58f), warp(seed + 1, 5, 6, 0.6f), pits(seed + 2, 28, 3, 0.6f),
      cracks(seed + 3, 4, 6, 0.55f);
  Field2 heights;
  parallel_for(kSize, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < kSize; ++x) {
      const float u = static_cast<float>(x) / kSize, v = static_cast<float>(y) / kSize;
      const float du = 0.05f * warp(u, v), dv = 0.05f * warp(v, u);
      const float pit = smoothstep(0.25f, 0.7f, pits(u, v));
      const float crack = smoothstep(0.03f, 0.0f, std::abs(cracks(u + du, v + dv))) *
                          smoothstep(0.1f, 0.5f, warp(u + 0.5f, v + 0.25f));
      heights.at(x, y) = 0.55f * shape(u + du, v + dv) - 0.14f * pit - 0.12f * crack;
    }
  });
  return heights;
}

std::uint8_t byte_of(float x) {
  return static_cast<std::uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255 + 0.5f);
}

void set_pixel(Image& image, int x, int y, const Vec3f& color) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * kSize + x);
  for (int c = 0; c < 3; ++c) image.pixels[at + static_cast<std::size_t>(c)] = byte_of(color[c]);
}

Image blank() {
  return {.width = kSize,
          .height = kSize,
          .channels = 3,
          .pixels = std::vector<std::uint8_t>(3ul * kSize * kSize)};
}

}  // namespace

StoneTextures make_stone_textures(std::uint64_t seed) {
  const Field2 heights = make_heights(seed);
  const Field2 around = blurred(heights, 6);
  const Octaves tone(seed + 4, 3, 5, 0.55f), lichen(seed + 5, 5, 6, 0.6f),
      grains(seed + 6, 96, 2, 0.8f);

  StoneTextures out{blank(), blank(), blank()};
  parallel_for(kSize, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < kSize; ++x) {
      const float u = static_cast<float>(x) / kSize, v = static_cast<float>(y) / kSize;
      const float height = heights.at(x, y);
      const float hollow = std::clamp(around.at(x, y) - height, -0.3f, 0.3f);
      const float grain = grains(u, v);
      const float growth = smoothstep(0.28f, 0.55f, lichen(u, v) - 0.8f * hollow);

      // Grey-brown rock: tone by region, dark and light grains, dirt in hollows, pale lichen.
      Vec3f color = mix({0.52f, 0.49f, 0.45f}, {0.72f, 0.69f, 0.63f},
                        smoothstep(-0.7f, 0.7f, tone(u, v) + 0.5f * height));
      color = mix(color, {0.30f, 0.28f, 0.26f}, 0.55f * smoothstep(0.35f, 0.75f, grain));
      color = mix(color, {0.86f, 0.84f, 0.79f}, 0.50f * smoothstep(0.35f, 0.75f, -grain));
      color *= 1 - 1.5f * hollow;
      color = mix(color, {0.66f, 0.67f, 0.55f}, 0.45f * growth);
      set_pixel(out.base_color, x, y, color);

      // Rows run downward, the normal's green axis upward.
      const float sx = heights.at(x + 1, y) - heights.at(x - 1, y);
      const float sy = heights.at(x, y + 1) - heights.at(x, y - 1);
      Vec3f normal(-kRelief / 2 * sx, kRelief / 2 * sy, 1);
      normal /= std::sqrt(normal.x * normal.x + normal.y * normal.y + 1);
      set_pixel(out.normal, x, y, 0.5f * normal + 0.5f);

      const float occlusion = 1 - 2.2f * std::max(hollow, 0.0f);
      const float roughness = 0.82f + 0.10f * growth + 0.25f * hollow - 0.05f * grain;
      set_pixel(out.occlusion_roughness, x, y, {occlusion, roughness, 0});
    }
  });
  return out;
}

}  // namespace talus
