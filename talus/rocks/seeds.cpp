#include "talus/rocks/seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "talus/base/hash.h"

namespace talus::rocks {
namespace {

// Draws for one seed: values with a running index under one purpose.
class Draws {
 public:
  Draws(std::uint64_t seed, Purpose purpose, std::uint64_t place)
      : seed_(seed), purpose_(purpose), place_(place) {}
  double next(double low, double high) {
    return uniform(hash(seed_, purpose_, place_, index_++), low, high);
  }

 private:
  std::uint64_t seed_;
  Purpose purpose_;
  std::uint64_t place_;
  int index_ = 0;
};

// Uniformly distributed rotation, by rejection: no trigonometry ([Marsaglia1972]).
glm::dmat3 random_rotation(Draws& draws) {
  const auto point_in_disk = [&] {
    for (;;) {
      const double x = draws.next(-1, 1), y = draws.next(-1, 1), r2 = x * x + y * y;
      if (r2 < 1 && r2 > 1e-12) return std::array{x, y, r2};
    }
  };
  const auto [x, y, r2] = point_in_disk();
  const auto [z, w, s2] = point_in_disk();
  const double scale = std::sqrt((1 - r2) / s2);
  return glm::mat3_cast(glm::dquat(w * scale, x, y, z * scale));
}

// Cube root of a positive number by Newton's method: the same bits from every compiler and library.
double cube_root(double a) {
  double x = std::max(a, 1.0);
  for (double next = x; (next = (2 * x + a / (x * x)) / 3) < x;) x = next;
  return x;
}

// Places of `count` seeds in a unit cell: the additive recurrence on the generalised golden ratio
// with a random start [Roberts2018]. Few seeds keep to the middle three quarters of each edge,
// which keeps stones compact; from four on the sequence itself spreads them.
Vec3 seed_place(int index, int count, const Vec3& start) {
  constexpr double kRatio = 1.2207440846057596;  // the real root of x^4 = x + 1
  const Vec3 step(1 / kRatio, 1 / (kRatio * kRatio), 1 / (kRatio * kRatio * kRatio));
  const Vec3 u = glm::fract(start + static_cast<double>(index) * step);
  return count < 4 ? 0.125 + 0.75 * u : u;
}

Seed make_seed(const TileParams& params, std::uint64_t seed, std::uint64_t place, const Vec3& at) {
  // Coefficients are squared reciprocals of the extents, scaled so that the shape leaves the
  // volume.
  Draws axes(seed, Purpose::seed_axes, place);
  const Vec3 extent(axes.next(params.axis_x.min, params.axis_x.max),
                    axes.next(params.axis_y.min, params.axis_y.max),
                    axes.next(params.axis_z.min, params.axis_z.max));
  const double volume = extent.x * extent.y * extent.z;
  const Vec3 coefficients = cube_root(volume * volume) / (extent * extent);
  const double g = uniform(hash(seed, Purpose::seed_size, place), 1, params.size_ratio);

  Draws frame(seed, Purpose::seed_frame, place);
  const glm::dmat3 axis = random_rotation(frame);
  glm::dmat3 form(0);
  for (int k = 0; k < 3; ++k) form += coefficients[k] / g * glm::outerProduct(axis[k], axis[k]);

  const double v = params.voxels() / params.n;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {.position = Vec3f(v * at),
          .xx = f(form[0][0]),
          .yy = f(form[1][1]),
          .zz = f(form[2][2]),
          .xy = f(2 * form[0][1]),
          .xz = f(2 * form[0][2]),
          .yz = f(2 * form[1][2])};
}

}  // namespace

SeedTable::SeedTable(const TileParams& params, std::uint64_t seed) : layout_(params) {
  first_.push_back(0);
  for (std::size_t c = 0; c < layout_.cell_count(); ++c) {
    const Int3 cell = layout_.cell_at(c);
    cell_keys_.push_back(first_.size() - 1);
    const std::uint32_t codes = code_count(layout_.seed_corners(cell), layout_.colors);
    for (std::uint32_t code = 0; code < codes; ++code) {
      const std::uint64_t key = hash(seed, Purpose::seed_count, cell.x, cell.y, cell.z, code);
      const int spread = params.seeds_max - params.seeds_min + 1;
      const int count = params.seeds_min + static_cast<int>(uniform(key) * spread);
      Draws draws(seed, Purpose::seed_position, key);
      const Vec3 start(draws.next(0, 1), draws.next(0, 1), draws.next(0, 1));
      for (int k = 0; k < count; ++k)
        seeds_.push_back(make_seed(params, seed, mix_bits(key + static_cast<std::uint64_t>(k)),
                                   seed_place(k, count, start)));
      first_.push_back(seeds_.size());
    }
  }
}

}  // namespace talus::rocks
