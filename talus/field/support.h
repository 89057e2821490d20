// Where stones may go: every shape that can be filled answers the same questions.
#pragma once

#include <optional>

#include "talus/base/vec.h"

namespace talus {

enum class BoxState { outside, inside, mixed };

// Thread-safe for concurrent reading. Derive to fill a shape of your own.
class Support {
 public:
  virtual ~Support() = default;

  virtual bool contains(const Vec3& p) const = 0;

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
