#include "talus/rocks/seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "talus/base/angle.h"
#include "talus/base/cube_root.h"
#include "talus/rocks/draws.h"
#include "talus/rocks/seed_places.h"

namespace talus::rocks {
namespace {

// Uniform in the unit disk, and its squared radius, which is not zero.
std::array<double, 3> point_in_disk(Draws& draws) {
  for (;;) {
    const double x = draws.next(-1, 1), y = draws.next(-1, 1), r2 = x * x + y * y;
    if (r2 < 1 && r2 > 1e-12) return {x, y, r2};
  }
}

// Uniformly distributed rotation, by rejection: no trigonometry ([Marsaglia1972]).
glm::dmat3 random_rotation(Draws& draws) {
  const auto [x, y, r2] = point_in_disk(draws);
  const auto [z, w, s2] = point_in_disk(draws);
  const double scale = std::sqrt((1 - r2) / s2);
  return glm::mat3_cast(glm::dquat(w * scale, x, y, z * scale));
}

// Two unit vectors that make a right-handed frame with a third, `axis`.
std::array<Vec3, 2> perpendicular(const Vec3& axis) {
  const Vec3 a = glm::abs(axis);
  const Vec3 least = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0)
                     : a.y <= a.z             ? Vec3(0, 1, 0)
                                              : Vec3(0, 0, 1);
  const Vec3 first = glm::normalize(glm::cross(least, axis));
  return {first, glm::cross(axis, first)};
}

// Uniform on the circle around `axis` of unit radius.
Vec3 random_perpendicular(const Vec3& axis, Draws& draws) {
  const auto [x, y, r2] = point_in_disk(draws);
  const auto [u, v] = perpendicular(axis);
  return (x * u + y * v) / std::sqrt(r2);
}

// The third axis is uniform on the cap of directions within `spread_deg` of `bedding`, the others
// are turned around it at random.
glm::dmat3 bedded_rotation(const Vec3& bedding, double spread_deg, Draws& draws) {
  const Vec3 up = glm::normalize(bedding);
  const double cosine = draws.next(cos_deg(spread_deg), 1);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vec3 third = glm::normalize(cosine * up + sine * random_perpendicular(up, draws));
  const Vec3 first = random_perpendicular(third, draws);
  return {first, glm::cross(third, first), third};
}

Seed make_seed(const TileParams& params, std::uint64_t seed, std::uint64_t place, const Vec3& at) {
  // Coefficients are squared reciprocals of the extents, scaled so that the shape leaves the
  // volume.
  Draws axes(seed, Purpose::seed_axes, place);
  // One statement each: the order in which arguments are evaluated is the compiler's choice.
  Vec3 extent;
  extent.x = axes.next(params.axis_x.min, params.axis_x.max);
  extent.y = axes.next(params.axis_y.min, params.axis_y.max);
  extent.z = axes.next(params.axis_z.min, params.axis_z.max);
  const double volume = extent.x * extent.y * extent.z;
  const Vec3 coefficients = cube_root(volume * volume) / (extent * extent);
  const double g = uniform(hash(seed, Purpose::seed_size, place), 1, params.size_ratio);

  Draws frame(seed, Purpose::seed_frame, place);
  const glm::dmat3 axis = params.frames == Frames::bedded
                              ? bedded_rotation(params.bedding, params.bedding_spread_deg, frame)
                              : random_rotation(frame);
  glm::dmat3 form(0);
  for (int k = 0; k < 3; ++k) form += coefficients[k] / g * glm::outerProduct(axis[k], axis[k]);

  constexpr double kSafety = 0.999;  // for coefficients rounded to float
  const double v = params.voxels() / params.n;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {.position = Vec3f(v * at),
          .xx = f(form[0][0]),
          .yy = f(form[1][1]),
          .zz = f(form[2][2]),
          .xy = f(2 * form[0][1]),
          .xz = f(2 * form[0][2]),
          .yz = f(2 * form[1][2]),
          .growth = f(kSafety * std::min({coefficients.x, coefficients.y, coefficients.z}) / g)};
}

}  // namespace

SeedTable::SeedTable(const TileParams& params, std::uint64_t seed) : layout_(params) {
  const std::vector<std::vector<Vec3>> places = place_seeds(params, seed);
  first_.push_back(0);
  for (std::size_t c = 0; c < layout_.cell_count(); ++c) {
    const Int3 cell = layout_.cell_at(c);
    cell_keys_.push_back(first_.size() - 1);
    const std::uint32_t codes = code_count(layout_.seed_corners(cell), layout_.colors);
    for (std::uint32_t code = 0; code < codes; ++code) {
      std::uint64_t place = seed_key(seed, cell, code);
      for (const Vec3& at : places[first_.size() - 1])
        seeds_.push_back(make_seed(params, seed, mix_bits(place++), at));
      first_.push_back(seeds_.size());
    }
  }
}

}  // namespace talus::rocks
