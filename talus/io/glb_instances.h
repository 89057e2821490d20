// Where stones stand, as nodes with EXT_mesh_gpu_instancing.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "talus/io/glb_file.h"
#include "talus/io/instance_cells.h"

namespace talus {

// A rotation of the world as x, y, z, w of glTF.
std::array<double, 4> y_up(const Quat& rotation);

// Refers to the table and itself holds what is written: both must live until the file is written.
class GlbInstances {
 public:
  // `center` is where the node above stands, `step` the length of one unit of the file's meshes for
  // an instance of scale 1.
  GlbInstances(const InstanceTable& stones, const Vec3& center, double step);

  // Adds a node `stones/<cell>` for each cell, and below it `stones/<cell>/<k>` for prototype k,
  // whose mesh is `first_mesh` + k. Returns the cells' nodes.
  //
  // What all instances of a node have in common, rotation and scale, stands on the node; what they
  // have not is an instance attribute.
  std::vector<std::size_t> add_to(GlbFile& file, std::size_t first_mesh) const;

 private:
  struct Views {
    std::size_t translations, rotations, scales;
  };
  // What a node does to all its instances.
  struct Frame {
    glm::dquat rotation{1, 0, 0, 0};
    double scale = 1;
  };

  const Instance& instance(std::size_t in_order) const {
    return stones_.instances[cells_.order[in_order]];
  }
  bool is_alike(const InstanceRun& run) const;
  Frame frame_of(const InstanceRun& run) const;
  Vec3 origin_of(const InstanceCell& cell) const;
  Views add_views(GlbFile& file) const;

  const InstanceTable& stones_;
  Vec3 center_;
  double step_;
  InstanceCells cells_;
  std::vector<Vec3f> translations_;   // one for each entry of the cells' order
  std::vector<glm::vec4> rotations_;  // one for each instance of runs that are not alike
  std::vector<Vec3f> scales_;
};

}  // namespace talus
