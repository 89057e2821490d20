#include "talus/piles/specimens.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <unordered_set>
#include <vector>

#include "talus/mesh/shape_measures.h"

namespace talus {
namespace {

constexpr double kSpacing = 1.05;         // between middles, in lengths of the longest stone
constexpr double kRowsPerColumn = 0.625;  // a picture is wider than high

struct Specimen {
  std::shared_ptr<const TriangleMesh> mesh;
  ShapeMeasures shape;
};

std::vector<Specimen> choose(const TileSet& tiles, int count) {
  std::unordered_set<const TriangleMesh*> seen;
  std::vector<const Stone*> distinct;
  for (const Stone& stone : tiles.stones())
    if (stone.mesh && seen.insert(stone.mesh.get()).second) distinct.push_back(&stone);
  const std::size_t chosen = std::min(distinct.size(), static_cast<std::size_t>(count));
  std::vector<Specimen> result;
  for (std::size_t i = 0; i < chosen; ++i) {
    const Stone& stone = *distinct[i * distinct.size() / chosen];
    result.push_back({stone.mesh, measure_shape(*stone.mesh)});
  }
  std::stable_sort(result.begin(), result.end(), [](const Specimen& a, const Specimen& b) {
    return a.shape.volume > b.shape.volume;
  });
  return result;
}

}  // namespace

InstanceTable specimens(const TileSet& tiles, int count) {
  const std::vector<Specimen> chosen = choose(tiles, count);
  double longest = 0;
  for (const Specimen& specimen : chosen) longest = std::max(longest, specimen.shape.lengths.x);
  const auto columns = std::max<std::size_t>(
      1, static_cast<std::size_t>(
             std::ceil(std::sqrt(static_cast<double>(chosen.size()) / kRowsPerColumn))));

  InstanceTable table;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const TriangleMesh& mesh = *chosen[i].mesh;
    Instance instance{.rotation = Quat(glm::quat_cast(glm::transpose(chosen[i].shape.axes))),
                      .prototype = static_cast<std::uint32_t>(i)};
    Box3 box;
    for (const Vec3f& p : mesh.positions) box.include(world_from_local(instance, p));
    const Vec3 middle = box.center();
    instance.position =
        Vec3(kSpacing * longest * static_cast<double>(i % columns) - middle.x,
             -kSpacing * longest * static_cast<double>(i / columns) - middle.y, -box.min.z);
    table.prototypes.push_back(chosen[i].mesh);
    table.instances.push_back(instance);
  }
  return table;
}

}  // namespace talus
