// Where stones may go: every shape that can be filled answers the same questions.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/vec.h"

namespace talus {

enum class BoxState { outside, inside, mixed };

// Thread-safe for concurrent reading. Derive to fill a shape of your own.
class Support {
 public:
  virtual ~Support() = default;

  virtual bool contains(const Vec3& p) const = 0;

  // Many points of a line at once: bit i, for i < count <= 64, is `contains(first + i * step)`, to
  // the bit. Worth deriving where neighbors share work.
  virtual std::uint64_t contains_row(const Vec3& first, const Vec3& step, int count) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < count; ++i)
      bits |= std::uint64_t{contains(first + static_cast<double>(i) * step)} << i;
    return bits;
  }

  // `inside` and `outside` are certain: every point of the closed box answers `contains` alike.
  // `mixed` promises nothing.
  virtual BoxState classify(const Box3& box) const = 0;

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
