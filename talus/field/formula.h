// Supports that a user writes: as a formula, or as a function of the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include "talus/field/formula_program.h"
#include "talus/field/gradient_noise.h"
#include "talus/field/support.h"

namespace talus {

// All points of a box for which a condition on their coordinates in metres holds, for example
// "z < 0.2 + 0.1 * sin(6 * hypot(x, y)) and not hypot(x, y) < 1".
//
// Numbers, x, y, z, pi; + - * / ^; < <= > >=; and, or, not; ( ); abs(a), min(a, b), max(a, b),
// clamp(a, low, high), floor(a), ceil(a), fract(a), mod(a, b), sqrt(a), hypot(a, b),
// length(a, b, c), sin(a), cos(a), tan(a), atan2(y, x), exp(a), log(a), pow(a, b), mix(a, b, t),
// step(edge, a), smoothstep(edge, edge, a), and noise(a, b, c), gradient noise in [-1, 1] that is 0
// where all arguments are whole. Angles are in radians, -a^b is -(a^b), mod takes the sign of b.
//
// What is not a number makes a comparison unknown, and a point where the whole condition is neither
// true nor false is outside. Boxes are classified by interval arithmetic. Bits do not depend on the
// machine.
class FormulaSupport final : public Support {
 public:
  // Throws `Error` (usage), with the column in the formula, for what cannot be read, is longer than
  // 10 000 characters or nested too deeply, and for a box without volume.
  FormulaSupport(std::string_view condition, const Box3& bounds, std::uint64_t seed = 1);

  bool contains(const Vec3& p) const override;
  BoxState classify(const Box3& box) const override;
  std::uint64_t contains_block(const PointBlock& block) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  FormulaProgram program_;
  Box3 bounds_;
  GradientNoise noise_;
};

// All points of a box that a function accepts, which must be safe to call from several threads.
// Every box that meets this one is mixed: where more is known, derive from `Support`.
class FunctionSupport final : public Support {
 public:
  FunctionSupport(std::function<bool(const Vec3&)> accepts, const Box3& bounds)
      : accepts_(std::move(accepts)), bounds_(bounds) {}

  bool contains(const Vec3& p) const override { return bounds_.contains(p) && accepts_(p); }
  BoxState classify(const Box3& box) const override {
    const Box3 part{glm::max(box.min, bounds_.min), glm::min(box.max, bounds_.max)};
    return part.empty() ? BoxState::outside : BoxState::mixed;
  }
  Box3 bounds() const override { return bounds_; }

 private:
  std::function<bool(const Vec3&)> accepts_;
  Box3 bounds_;
};

}  // namespace talus
