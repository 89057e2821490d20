#include "talus/io/mesh_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "talus/base/error.h"
#include "talus/io/atomic_file.h"
#include "talus/io/material_color.h"
#include "talus/io/print.h"

namespace talus {
namespace {

constexpr std::size_t kProgressInstances = 1024;

// Prototypes may come without normals; those written are then computed once per prototype.
std::vector<TriangleMesh> normals_where_missing(const InstanceTable& table) {
  std::vector<TriangleMesh> out(table.prototypes.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (table.prototypes[k]->normals.empty()) {
      out[k] = *table.prototypes[k];
      compute_normals(out[k]);
    }
  return out;
}

// All parts as one table: the surfaces, each with its name, then the stones.
class WholeScene {
 public:
  explicit WholeScene(const SceneView& scene) {
    add_surface("ground", scene.ground, Material::bedrock);
    add_surface("water", scene.water, Material::water);
    if (scene.stones) {
      const auto first = static_cast<std::uint32_t>(surfaces_.size());
      table_.prototypes.insert(table_.prototypes.end(), scene.stones->prototypes.begin(),
                               scene.stones->prototypes.end());
      for (Instance instance : scene.stones->instances) {
        instance.prototype += first;
        table_.instances.push_back(instance);
      }
    }
    computed_ = normals_where_missing(table_);
  }

  const InstanceTable& table() const { return table_; }
  const TriangleMesh& mesh(std::uint32_t prototype) const { return *table_.prototypes[prototype]; }
  const std::vector<Vec3f>& normals(std::uint32_t prototype) const {
    const TriangleMesh& given = mesh(prototype);
    return given.normals.empty() ? computed_[prototype].normals : given.normals;
  }

  // Whether any vertex tells its materials.
  bool has_shares() const {
    return std::any_of(table_.prototypes.begin(), table_.prototypes.end(),
                       [](const auto& mesh) { return !mesh->shares.empty(); });
  }
  MaterialShares shares(std::uint32_t prototype, std::size_t vertex) const {
    const TriangleMesh& given = mesh(prototype);
    if (!given.shares.empty()) return given.shares[vertex];
    return pure(prototype < surfaces_.size() ? surfaces_[prototype].material : Material::rocks);
  }

  // Of the instance that is `in_run`th of its prototype.
  std::string name(std::uint32_t prototype, std::uint32_t in_run) const {
    if (prototype < surfaces_.size()) return surfaces_[prototype].name;
    return fmt::format("stones/{}/{}", prototype - surfaces_.size(), in_run);
  }

 private:
  struct Surface {
    const char* name;
    Material material;  // where the mesh does not tell
  };

  void add_surface(const char* name, const PlacedMesh& placed, Material material) {
    if (!placed.mesh) return;
    // The scene keeps the mesh.
    table_.prototypes.emplace_back(std::shared_ptr<const TriangleMesh>(), placed.mesh);
    table_.instances.push_back(
        {.position = placed.origin, .prototype = static_cast<std::uint32_t>(surfaces_.size())});
    surfaces_.push_back({name, material});
  }

  InstanceTable table_;
  std::vector<Surface> surfaces_;
  std::vector<TriangleMesh> computed_;
};

std::uint64_t vertex_count(const InstanceTable& table) {
  std::uint64_t count = 0;
  for (const Instance& instance : table.instances)
    count += table.prototypes[instance.prototype]->positions.size();
  return count;
}

void report(Job* job, std::string_view stage, std::size_t i, std::size_t count) {
  if (i % kProgressInstances == 0)
    report_progress(job, stage, static_cast<double>(i) / static_cast<double>(count));
}

std::string ply_header(const WholeScene& scene) {
  std::string shares;
  if (scene.has_shares()) {
    shares = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    for (const MaterialInfo& info : material_infos())
      shares += fmt::format("property uchar {}\n", info.name);
  }
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Talus, metres, z up\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertex_count(scene.table()), shares, triangle_count(scene.table()));
}

}  // namespace

void write_ply(const std::filesystem::path& path, const SceneView& view, Job* job) {
  const WholeScene scene(view);
  const std::vector<Instance>& instances = scene.table().instances;
  const std::uint64_t vertices = vertex_count(scene.table());
  if (vertices > std::numeric_limits<std::int32_t>::max())
    throw job_error(
        fmt::format("{}: {} vertices are more than a PLY face can name (2^31 - 1); "
                    "write instances as GLB",
                    path.string(), vertices));
  AtomicFile file(path);
  file.write(ply_header(scene));

  const bool has_shares = scene.has_shares();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    report(job, "write PLY", i, 2 * instances.size());
    const Instance& instance = instances[i];
    const TriangleMesh& mesh = scene.mesh(instance.prototype);
    const std::vector<Vec3f>& normals = scene.normals(instance.prototype);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      file.write_value(world_from_local(instance, mesh.positions[v]));
      file.write_value(instance.rotation * normals[v]);
      if (!has_shares) continue;
      const MaterialShares shares = scene.shares(instance.prototype, v);
      file.write_value(srgb_bytes(blended_color(shares)));
      file.write_value(shares);
    }
  }
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    report(job, "write PLY", instances.size() + i, 2 * instances.size());
    const TriangleMesh& mesh = scene.mesh(instances[i].prototype);
    for (const Triangle& t : mesh.triangles) {
      file.write_value(std::uint8_t{3});
      file.write_value(t + first);
    }
    first += static_cast<std::uint32_t>(mesh.positions.size());
  }
  file.commit();
}

void write_obj(const std::filesystem::path& path, const SceneView& view, Job* job) {
  const WholeScene scene(view);
  const std::vector<Instance>& instances = scene.table().instances;
  AtomicFile file(path);
  file.write("# Talus, metres, y up\n");

  // One hundred-millionth of the scene, written out as decimals.
  const double longest = instances.empty() ? 1 : bounds(scene.table()).longest_side();
  const int decimals =
      std::clamp(8 - static_cast<int>(std::ceil(std::log10(std::max(longest, 1e-9)))), 0, 17);

  std::uint64_t first = 1;
  std::uint32_t run_prototype = 0, run_index = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    report(job, "write OBJ", i, instances.size());
    const Instance& instance = instances[i];
    run_index = instance.prototype == run_prototype ? run_index : 0;
    run_prototype = instance.prototype;
    const TriangleMesh& mesh = scene.mesh(instance.prototype);
    print(file, "o {}\n", scene.name(instance.prototype, run_index++));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3 p = world_from_local(instance, mesh.positions[v]);
      print(file, "v {:.{}f} {:.{}f} {:.{}f}", p.x, decimals, p.z, decimals, -p.y, decimals);
      if (!mesh.shares.empty()) {
        const auto [red, green, blue] = srgb_bytes(blended_color(mesh.shares[v]));
        print(file, " {:.3f} {:.3f} {:.3f}", red / 255.0, green / 255.0, blue / 255.0);
      }
      file.write("\n");
    }
    for (const Vec3f& local : scene.normals(instance.prototype)) {
      const Vec3f n = instance.rotation * local;
      print(file, "vn {:.4f} {:.4f} {:.4f}\n", n.x, n.z, -n.y);
    }
    for (const Triangle& t : mesh.triangles) {
      print(file, "f {0}//{0} {1}//{1} {2}//{2}\n", first + t.x, first + t.y, first + t.z);
    }
    first += mesh.positions.size();
  }
  file.commit();
}

}  // namespace talus
