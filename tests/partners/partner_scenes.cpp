// Writes the files that partners read, and beside them where everything should be.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>

#include "io/scenes.h"
#include "talus/io/atomic_file.h"
#include "talus/io/glb_writer.h"
#include "talus/io/mesh_writer.h"
#include "talus/io/usda_writer.h"

namespace talus {
namespace {

// Far enough from the origin that floats alone would lose millimetres.
const Vec3 kCenter(2'000, 50'000, 800);

double reach(const TriangleMesh& mesh) {
  double farthest = 0;
  for (const Vec3f& p : mesh.positions) farthest = std::max(farthest, glm::length(Vec3(p)));
  return farthest;
}

// The instances as JSON: prototype and how many triangles and what reach it has, world position (z
// up), quaternion x y z w, scale.
void write_table(const std::filesystem::path& path, const InstanceTable& stones) {
  AtomicFile file(path);
  file.write("[");
  for (std::size_t i = 0; i < stones.instances.size(); ++i) {
    const Instance& s = stones.instances[i];
    const TriangleMesh& mesh = *stones.prototypes[s.prototype];
    file.write(fmt::format(
        "{}\n{{\"prototype\": {}, \"triangles\": {}, \"reach\": {}, \"position\": [{}, {}, {}], "
        "\"rotation\": [{}, {}, {}, {}], \"scale\": {}}}",
        i > 0 ? "," : "", s.prototype, mesh.triangles.size(), reach(mesh), s.position.x,
        s.position.y, s.position.z, s.rotation.x, s.rotation.y, s.rotation.z, s.rotation.w,
        s.scale));
  }
  file.write("\n]\n");
  file.commit();
}

// As a pile has its stones: what they share stands on the nodes, and they fill several cells.
InstanceTable turned_alike(InstanceTable stones) {
  const Instance first = stones.instances[0];
  for (Instance& stone : stones.instances) {
    stone.rotation = first.rotation;
    stone.scale = first.scale;
  }
  return stones;
}

void write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const InstanceTable stones = test::heap(300, kCenter);
  write_table(folder / "stones.json", stones);
  const InstanceTable pile = turned_alike(test::heap(20'000, kCenter));
  write_table(folder / "pile.json", pile);
  write_glb(folder / "pile.glb", {.stones = &pile});
  // Blender keeps single precision: near the origin that is well below a millimetre.
  const InstanceTable near_stones = test::heap(3'000);
  write_glb(folder / "near.glb", {.stones = &near_stones});
  write_glb(folder / "near_nodes.glb", {.stones = &near_stones},
            {.instances = InstanceMode::nodes});
  const SceneView scene{.stones = &stones};
  write_glb(folder / "gpu.glb", scene, {.instances = InstanceMode::gpu});
  write_glb(folder / "nodes.glb", scene, {.instances = InstanceMode::nodes});
  write_glb(folder / "flattened.glb", scene, {.instances = InstanceMode::flattened});
  write_glb(folder / "empty.glb", {});
  write_ply(folder / "stones.ply", scene);

  const TriangleMesh ground = test::hill(), water = test::pool();
  const SceneView landscape{
      .stones = &stones, .ground = {&ground, kCenter}, .water = {&water, kCenter}};
  write_glb(folder / "landscape.glb", landscape);
  write_usda(folder / "landscape.usda", landscape);
}

}  // namespace
}  // namespace talus

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: partner_scenes FOLDER\n", stderr);
    return 2;
  }
  talus::write_all(argv[1]);
}
