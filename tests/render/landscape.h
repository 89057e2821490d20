// A block of mountain with a ravine, an overhang, a cave and shares of materials.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "talus/base/parallel.h"
#include "talus/field/gradient_noise.h"
#include "talus/mesh/polygonize.h"

namespace talus::test {

enum LandscapeSurface : std::size_t { kRock, kSand, kSoil, kSnow, kIce, kGravel };

// A block `size` metres wide with its south-west corner at (0, 0, 0); `cells` along each side. A
// ravine runs from south to north, a cave opens at half its length into the western wall.
class Landscape {
 public:
  explicit Landscape(double size) : size_(size) {}

  double height(double x, double y) const {
    const Vec2 p(x / size_, y / size_);
    const double rise = 0.20 + 0.14 * fractal(noise_, 2.3 * p, {.octaves = 9, .ridged = 0.4});
    const double wall = smooth(0.035, 0.085, away_from_ravine(x, y));
    return size_ * std::lerp(floor_height(p.y), std::max(rise, floor_height(p.y)), wall);
  }

  // Metres from the ravine's middle, as a share of the size.
  double away_from_ravine(double x, double y) const {
    const Vec2 p(x / size_, y / size_);
    return std::abs(p.x - 0.5 - 0.09 * std::sin(7 * p.y) - 0.02 * noise_.at(Vec2(9.0 * p.y, 3.5)));
  }

  TriangleMesh mesh(int cells) const {
    const double cell = size_ / cells;
    const Int3 n(cells + 3, cells + 3, static_cast<int>(0.42 * cells) + 3);
    const auto nx = static_cast<std::size_t>(n.x);
    std::vector<float> values(nx * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z),
                              -1.0f);
    parallel_for(static_cast<std::size_t>(n.y - 2), [&](std::size_t row) {
      const int y = static_cast<int>(row) + 1;
      for (int x = 1; x < n.x - 1; ++x) {
        const Vec3 at(cell * (x - 1), cell * (y - 1), 0);
        const double h = height(at.x, at.y);
        for (int z = 1; z < n.z - 1; ++z)
          values[static_cast<std::size_t>(x) +
                 nx * (static_cast<std::size_t>(y) +
                       static_cast<std::size_t>(n.y) * static_cast<std::size_t>(z))] =
              static_cast<float>(density(Vec3(at.x, at.y, cell * (z - 1)), h) / cell);
      }
    });
    PolygonizeScratch scratch;
    TriangleMesh made = polygonize({n, values}, scratch);
    for (Vec3f& p : made.positions) p = static_cast<float>(cell) * (p - 1.0f);
    compute_normals(made);
    set_shares(made);
    return made;
  }

 private:
  static double smooth(double low, double high, double v) {
    const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }
  static double floor_height(double y) { return 0.07 + 0.03 * y; }

  // Positive inside.
  double density(const Vec3& p, double h) const {
    double d = h - p.z;
    if (std::abs(d) < 0.12 * size_) {
      // Beds of changing hardness stand out of the walls.
      const Vec3 q = p / size_;
      const Vec3 warp = fractal(noise_, 9.0 * q, {.octaves = 6});
      d = height(p.x + 0.018 * size_ * warp.x + 0.010 * size_ * std::sin(170 * q.z + 3 * warp.y),
                 p.y + 0.012 * size_ * warp.y) -
          p.z + 0.012 * size_ * warp.z * smooth(0.03, 0.06, away_from_ravine(p.x, p.y));
    }
    // A cave behind the western wall.
    const Vec3 cave = (p / size_ - Vec3(0.43, 0.5, 0.105)) / Vec3(0.11, 0.035, 0.028);
    if (glm::length(cave) < 2) {
      const Vec3 warp = fractal(noise_, 16.0 / size_ * p, {.octaves = 5});
      d = std::min(d, 0.02 * size_ * (glm::length(cave + 0.4 * warp) - 1));
    }
    return std::min(d, p.z - 0.001 * size_);
  }

  void set_shares(TriangleMesh& mesh) const {
    mesh.shares.resize(mesh.positions.size());
    parallel_for(
        mesh.positions.size(),
        [&](std::size_t i) {
          const Vec3 p(mesh.positions[i]), q = p / size_;
          const double up = mesh.normals[i].z;
          const double patches = fractal(noise_, 14.0 * Vec2(q.x, q.y), {.octaves = 5});
          const bool on_top = p.z > height(p.x, p.y) - 0.03 * size_;
          double left = 1;
          const auto take = [&](double share) {
            const double taken = left * std::clamp(share, 0.0, 1.0);
            left -= taken;
            return taken;
          };
          const double snow =
              take(smooth(0.27, 0.295, q.z + 0.03 * patches) * smooth(0.5, 0.7, up));
          const double sand =
              take(smooth(0.02, 0.0, q.z - floor_height(q.y) - 0.012 + 0.004 * patches) *
                   smooth(0.7, 0.85, up));
          const double soil =
              take(on_top ? smooth(0.72, 0.86, up + 0.15 * patches) * smooth(0.0, 0.01, q.z - 0.1)
                          : 0.0);
          const auto steps = [](double share) {
            return static_cast<std::uint8_t>(255 * share + 0.5);
          };
          MaterialShares& s = mesh.shares[i];
          s[kSnow] = steps(snow);
          s[kSand] = steps(sand);
          s[kSoil] = std::min<std::uint8_t>(steps(soil),
                                            static_cast<std::uint8_t>(255 - s[kSnow] - s[kSand]));
          s[kRock] = static_cast<std::uint8_t>(255 - s[kSnow] - s[kSand] - s[kSoil]);
        },
        4096);
  }

  GradientNoise noise_{5};
  double size_;
};

}  // namespace talus::test
