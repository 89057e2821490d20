#include "talus/piles/cube_survey.h"

#include <algorithm>
#include <cmath>

namespace talus::piles {
namespace {

class Surveyor {
 public:
  Surveyor(const ChoiceRule& rule, std::uint64_t cubes_max) : rule_(rule), cubes_max_(cubes_max) {}

  // Lists the cubes of a box, until there are too many.
  void look_at(const CubeBox& box) {
    if (std::min({box.size.x, box.size.y, box.size.z}) == 0 || too_many_) return;
    const BoxState state = classify(box);
    const bool is_one = box.volume() == 1;
    if (state == BoxState::mixed && !is_one) return look_into(box);
    if (state == BoxState::outside) {
      seen_ += box.volume();
      return;
    }
    found_ += box.volume();
    filled_ += state == BoxState::inside ? box.volume() : 0.5;
    seen_ += box.volume();
    too_many_ = found_ > static_cast<double>(cubes_max_);
    if (too_many_) return;
    for (int z = 0; z < box.size.z; ++z)
      for (int y = 0; y < box.size.y; ++y)
        for (int x = 0; x < box.size.x; ++x) cubes_.push_back(box.first + Int3(x, y, z));
  }

  CubeSurvey result(const CubeBox& all) {
    if (too_many_) return {.filled_estimate = filled_ * all.volume() / seen_};
    std::sort(cubes_.begin(), cubes_.end(), is_before);
    return {.cubes = std::move(cubes_), .filled_estimate = filled_};
  }

 private:
  BoxState classify(const CubeBox& box) const {
    const Vec3 first(rule_.period * box.first), size(rule_.period * box.size);
    const double reach = rule_.tiles.reach();
    return rule_.support.classify(rule_.tiling.world(Box3{first - reach, first + size + reach}));
  }

  void look_into(const CubeBox& box) {
    const Int3 half = (box.size + 1) / 2;
    for (int part = 0; part < 8; ++part) {
      const Int3 upper(part & 1, part >> 1 & 1, part >> 2 & 1);
      look_at({box.first + upper * half, half + upper * (box.size - 2 * half)});
    }
  }

  const ChoiceRule& rule_;
  std::uint64_t cubes_max_;
  bool too_many_ = false;
  double found_ = 0;   // cubes that can have stones
  double filled_ = 0;  // those that are mixed counted half
  double seen_ = 0;    // cubes looked at
  std::vector<Int3> cubes_;
};

}  // namespace

CubeExtent cubes_around(const Box3& bounds, const Tiling& tiling, const TileSet& tiles) {
  const glm::dmat3 back = glm::transpose(tiling.turn);
  Box3 cells;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                 corner & 4 ? bounds.max.z : bounds.min.z);
    cells.include(back * (p - tiling.origin) / tiling.cell_size);
  }
  const double period = tiles.params().n - 1;
  const Vec3 first = glm::floor((cells.min - tiles.reach()) / period);
  return {first, glm::floor((cells.max + tiles.reach()) / period) + 1.0 - first};
}

CubeSurvey survey_cubes(const ChoiceRule& rule, const CubeBox& all, std::uint64_t cubes_max) {
  Surveyor surveyor(rule, cubes_max);
  surveyor.look_at(all);
  return surveyor.result(all);
}

}  // namespace talus::piles
