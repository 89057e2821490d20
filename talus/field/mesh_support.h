// The inside of a triangle mesh, sane also where the mesh is torn, flipped or crosses itself.
#pragma once

#include <cstdint>
#include <memory>

#include "talus/base/job.h"
#include "talus/field/support.h"
#include "talus/mesh/triangle_mesh.h"

namespace talus {

// What was wrong with a mesh and what was done about it.
struct MeshSupportReport {
  std::uint64_t triangles = 0;       // as given
  std::uint64_t degenerate = 0;      // without area, dropped
  std::uint64_t duplicates = 0;      // same three corners as another, dropped
  std::uint64_t flipped = 0;         // turned to agree with their neighbours
  std::uint64_t boundary_edges = 0;  // open after joining equal positions
  std::uint64_t non_manifold_edges = 0;
  bool inverted = false;     // faced inward as a whole, turned
  bool overlapping = false;  // crosses itself or has parts inside each other: some cell is wound
                             // around more than once
  double volume = 0;         // enclosed, m^3: of a closed mesh exact, overlaps counted as often as
                             // they are wound around; of an open one from samples
};

// A point is inside where the generalised winding number ([Jacobson2013]) exceeds one half in
// magnitude. For a closed mesh the answer is exact; across a hole it follows the number's value at
// the middle of the grid cell around the point, 1/24 to 1/128 of the longest side.
class MeshSupport final : public Support {
 public:
  // Throws `Error` (input) if the mesh has no triangles, a coordinate that is not finite, an index
  // out of range, or encloses no volume.
  explicit MeshSupport(const TriangleMesh& mesh, Job* job = nullptr);
  ~MeshSupport() override;

  bool contains(const Vec3& p) const override;
  BoxState classify(const Box3& box) const override;
  std::uint64_t contains_block(const PointBlock& block) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  Box3 bounds() const override;

  const MeshSupportReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace talus
