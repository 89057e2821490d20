#include "talus/rocks/damping.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/lanes.h"

namespace talus::rocks {
namespace {

// Both voxels at a contact keep all their matter: their centers are half a voxel from the face.
constexpr double kLeastRadius = 0.5;

// A Gaussian is followed to where less than a fiftieth of it is left.
constexpr double kGaussianEnd = 2;

// exp(-t) for t up to 4, to a millionth; with the same bits everywhere, which std::exp has not.
double falling(double t) {
  constexpr int kSquarings = 8;
  const double u = t / (1 << kSquarings);
  double result = 1 - u * (1 - u / 2 * (1 - u / 3));
  for (int i = 0; i < kSquarings; ++i) result *= result;
  return result;
}

using Shares [[gnu::vector_size(2 * kLanes)]] = std::uint16_t;

// Lowers the first `count` elements of a row to their limits. What follows either is read, too.
void limit_row(const std::uint16_t* limit, int count, std::uint16_t* row) {
  constexpr Shares kLane = {0, 1, 2, 3, 4, 5, 6, 7};
  for (; count > 0; count -= kLanes, limit += kLanes, row += kLanes) {
    const Shares old = load<Shares>(row), least = load<Shares>(limit);
    const auto left = static_cast<std::uint16_t>(std::min(count, kLanes));
    store((kLane < left) & (least < old) ? least : old, row);
  }
}

}  // namespace

Damping::Damping(const TileParams& params, int voxels_per_cell) {
  // Pebbles touch at points.
  const double roundness = params.weathering.roundness;
  radius_ = params.contacts.radius * voxels_per_cell * (1 - 0.5 * roundness);
  blend_ = params.contacts.blend * voxels_per_cell * (1 - 0.25 * roundness);
  if (params.contacts.gaussian_radius)
    gaussian_radius_ = *params.contacts.gaussian_radius * voxels_per_cell * (1 - 0.5 * roundness);
}

double Damping::share_at(double distance, double scale) const {
  if (distance <= kLeastRadius) return 0;
  if (gaussian_radius_) {
    const double r = std::max(*gaussian_radius_ * scale, kLeastRadius);
    return distance < kGaussianEnd * r ? 1 - falling((distance * distance) / (r * r)) : 1;
  }
  const double radius = std::max(radius_ * scale, kLeastRadius);
  const double blend = std::max(blend_ * scale, radius);
  return distance <= radius ? 0 : distance >= blend ? 1 : (distance - radius) / (blend - radius);
}

Damping::Stencil Damping::make_stencil(int axis, double scale) const {
  const double end = gaussian_radius_ ? kGaussianEnd * *gaussian_radius_ : blend_;
  const int reach = static_cast<int>(std::ceil(std::max(end * scale, kLeastRadius)));
  Stencil stencil{.first = Int3(-reach), .size = Int3(2 * reach + 1)};
  ++stencil.size[axis];
  for (int z = 0; z < stencil.size.z; ++z)
    for (int y = 0; y < stencil.size.y; ++y)
      for (int x = 0; x < stencil.size.x; ++x) {
        Vec3 from_face(stencil.first + Int3(x, y, z));
        from_face[axis] -= 0.5;
        stencil.shares.push_back(
            static_cast<std::uint16_t>(kFullShare * share_at(glm::length(from_face), scale)));
      }
  stencil.shares.resize(stencil.shares.size() + kLanes);
  return stencil;
}

const Damping::Stencils& Damping::stencils(const StoneGrid& grid) {
  const auto stones = static_cast<std::size_t>(grid.stones_in_cell());
  if (stones >= by_stones_in_cell_.size()) by_stones_in_cell_.resize(stones + 1);
  Stencils& made = by_stones_in_cell_[stones];
  if (made[0].shares.empty())
    for (int axis = 0; axis < 3; ++axis)
      made[static_cast<std::size_t>(axis)] = make_stencil(axis, grid.size_scale());
  return made;
}

void Damping::find_shares(const StoneGrid& grid, std::span<const Contact> contacts,
                          std::vector<std::uint16_t>& shares) {
  shares.assign(grid.count() + kLanes, kFullShare);
  const Stencils& per_axis = stencils(grid);
  for (const Contact& contact : contacts) {
    if (contact.discarded) continue;
    const int axis = contact.axis();
    const Stencil& stencil = per_axis[static_cast<std::size_t>(axis)];
    Int3 twice_lower = contact.face - 1;
    --twice_lower[axis];
    const Int3 at = twice_lower / 2 + stencil.first - grid.min();  // of the stencil in the grid
    const Int3 begin = glm::max(-at, 0), end = glm::min(stencil.size, grid.size() - at);
    for (int z = begin.z; z < end.z; ++z)
      for (int y = begin.y; y < end.y; ++y) {
        const int from = begin.x + stencil.size.x * (y + stencil.size.y * z);
        const std::uint16_t* const limit = &stencil.shares[static_cast<std::size_t>(from)];
        std::uint16_t* const row = &shares[grid.index(grid.min() + at + Int3(begin.x, y, z))];
        limit_row(limit, end.x - begin.x, row);
      }
  }
  shares.resize(grid.count());
}

}  // namespace talus::rocks
