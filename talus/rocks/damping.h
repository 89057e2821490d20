// How far weathering stays away from where stones touch.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/rocks/contacts.h"

namespace talus::rocks {

// The share omega of weathering that reaches each voxel: 0 at contacts, 1 far from them, the least
// over all contacts in between ([Peytavie2009] section 5). Lengths shrink with the stones where
// several share a cell, and with roundness.
class Damping {
 public:
  static constexpr int kFullShare = 1024;

  Damping(const TileParams& params, int voxels_per_cell);

  // Sets the share, of kFullShare, of every voxel of the grid.
  void find_shares(const StoneGrid& grid, std::span<const Contact> contacts,
                   std::vector<std::uint16_t>& shares);

 private:
  // Shares around a contact on a face across one axis, for voxels from `first` on, relative to the
  // face's lower voxel.
  struct Stencil {
    Int3 first, size;
    std::vector<std::uint16_t> shares;  // with room for kLanes more
  };
  using Stencils = std::array<Stencil, 3>;  // per axis

  double share_at(double distance, double scale) const;
  Stencil make_stencil(int axis, double scale) const;
  const Stencils& stencils(const StoneGrid& grid);

  // In voxels.
  double radius_, blend_;
  std::optional<double> gaussian_radius_;
  std::vector<Stencils> by_stones_in_cell_;  // made when first needed
};

}  // namespace talus::rocks
