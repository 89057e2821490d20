// What a pile's stones take up, as a support: to keep other stones out of it.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/field/support.h"
#include "talus/piles/pile.h"

namespace talus {

// The voxels of the stones that lie where the pile's tiling has them and those next to these, by a
// face, an edge or a corner: no stone whose voxels' centers lie outside, and whose voxels are at
// most half as large, meets a mesh of the pile. Takes a bit for each voxel of the cubes in and
// around the pile.
class PileSupport final : public Support {
 public:
  explicit PileSupport(const Pile& pile);

  bool contains(const Vec3& p) const override;
  BoxState classify(const Box3& box) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  struct CubeVoxels {
    std::vector<std::uint64_t> bits;
    Box3 box;  // around those that are set, in voxels
  };
  void add(const Stone& stone, const Int3& cell);
  void set_row(const Int3& first, int count);
  const CubeVoxels* find(const Int3& cube) const;
  bool is_set(const Int3& voxel) const;
  // Of a voxel of a cube.
  std::uint32_t bit_of(const Int3& v) const {
    return static_cast<std::uint32_t>(v.x + cube_voxels_ * (v.y + cube_voxels_ * v.z));
  }
  Box3 in_voxels(const Box3& world) const;
  BoxState look(const Int3& first, const Int3& last) const;

  Tiling tiling_;
  int cube_voxels_;  // along a cube
  double voxel_;     // m
  Int3 first_{0}, size_{0};
  std::vector<std::uint32_t> slots_;  // per cube around the pile, 1 + its place in `cubes_`
  std::vector<CubeVoxels> cubes_;
  Box3 bounds_;
};

}  // namespace talus
