// Noise over the plane and over space, for shapes.
#pragma once

#include <cstdint>

#include "talus/base/hash.h"
#include "talus/base/vec.h"

namespace talus {

// Gradient noise ([Perlin2002]): zero at integer points, smooth, within [-1, 1]. A function of seed
// and place alone; only additions and multiplications, so that every machine gets the same bits.
class GradientNoise {
 public:
  explicit GradientNoise(std::uint64_t seed) : root_(hash(seed, Purpose::gradient_noise)) {}

  double at(const Vec2& p) const;
  // Three independent noises at one place.
  Vec3 at(const Vec3& p) const;

 private:
  std::uint64_t root_;  // of the lattice points' hashes
};

// Octaves of noise, each `lacunarity` times finer than the one before and `gain` times as strong,
// scaled to [-1, 1].
struct FractalParams {
  int octaves = 6;
  double gain = 0.5;
  double lacunarity = 2.03;  // no whole number, so that the lattices do not coincide
  double ridged = 0;         // 0: rolling; 1: every zero of the noise is a crest
};

double fractal(const GradientNoise& noise, Vec2 p, const FractalParams& params);
Vec3 fractal(const GradientNoise& noise, Vec3 p, const FractalParams& params);

}  // namespace talus
