// Where stones may go: every shape that can be filled answers the same questions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "talus/base/vec.h"

namespace talus {

enum class BoxState { outside, inside, mixed };

// 4 x 4 x 4 points of a lattice whose steps are at right angles. Bit x + 4 y + 16 z of a mask is
// that of the point first + x step[0] + y step[1] + z step[2], summed in this order.
struct PointBlock {
  Vec3 first{0};
  std::array<Vec3, 3> step;

  Vec3 point(int i) const {
    return first + double(i & 3) * step[0] + double(i >> 2 & 3) * step[1] +
           double(i >> 4) * step[2];
  }
  Vec3 middle() const { return first + 1.5 * (step[0] + step[1] + step[2]); }
  // Of a ball around the middle that holds all points.
  double radius() const {
    return 1.5 * std::sqrt(glm::dot(step[0], step[0]) + glm::dot(step[1], step[1]) +
                           glm::dot(step[2], step[2]));
  }
  // The box around boxes that reach that far from the points.
  Box3 box_around(const Vec3& half) const {
    const Vec3 reach = half + 1.5 * (glm::abs(step[0]) + glm::abs(step[1]) + glm::abs(step[2]));
    const Vec3 center = middle(), slack = 1e-12 * (glm::abs(center) + reach);
    return {center - reach - slack, center + reach + slack};
  }
  // Whether points above one another share x and y, as long as no tiling is turned.
  bool is_upright() const {
    return step[0].z == 0 && step[1].z == 0 && step[2].x == 0 && step[2].y == 0;
  }
};
inline constexpr int kBlockPoints = 64;

// Boxes around the points of a block that are surely inside, and surely outside.
struct BlockStates {
  std::uint64_t inside = 0;
  std::uint64_t outside = 0;
};

// Thread-safe for concurrent reading. Derive to fill a shape of your own.
class Support {
 public:
  virtual ~Support() = default;

  virtual bool contains(const Vec3& p) const = 0;

  // `inside` and `outside` are certain: every point of the closed box answers `contains` alike.
  // `mixed` promises nothing.
  virtual BoxState classify(const Box3& box) const = 0;

  // Many at once: bits are what `contains` answers for the points, to the bit; states of boxes that
  // reach that far from them hold as `classify`'s do. Worth deriving where neighbors share
  // work.
  virtual std::uint64_t contains_block(const PointBlock& block) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < kBlockPoints; ++i) bits |= std::uint64_t{contains(block.point(i))} << i;
    return bits;
  }
  virtual BlockStates classify_block(const PointBlock& centers, const Vec3& half) const {
    BlockStates states;
    for (int i = 0; i < kBlockPoints; ++i) {
      const Vec3 center = centers.point(i);
      const BoxState state = classify({center - half, center + half});
      states.inside |= std::uint64_t{state == BoxState::inside} << i;
      states.outside |= std::uint64_t{state == BoxState::outside} << i;
    }
    return states;
  }

  // What `contains` answers at p, and how far around: every point closer than `radius` answers
  // alike. Nothing where that is no cheaper than to ask for boxes.
  struct Clearance {
    bool inside = false;
    double radius = 0;
  };
  virtual std::optional<Clearance> clearance(const Vec3& /*p*/) const { return {}; }

  // Every point that `contains` accepts lies in this box.
  virtual Box3 bounds() const = 0;
};

}  // namespace talus
