// Random values one after another for one place.
#pragma once

#include "talus/base/hash.h"
#include "talus/base/vec.h"

namespace talus::rocks {

// Values with a running index under one purpose, for example for one seed.
class Draws {
 public:
  Draws(std::uint64_t seed, Purpose purpose, std::uint64_t place)
      : seed_(seed), purpose_(purpose), place_(place) {}

  double next(double low, double high) {
    return uniform(hash(seed_, purpose_, place_, index_++), low, high);
  }
  Vec3 next_point() {
    const double x = next(0, 1), y = next(0, 1), z = next(0, 1);
    return {x, y, z};
  }

 private:
  std::uint64_t seed_;
  Purpose purpose_;
  std::uint64_t place_;
  int index_ = 0;
};

}  // namespace talus::rocks
