#include "talus/io/mesh_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "talus/base/error.h"
#include "talus/io/atomic_file.h"

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

// The table with every prototype's normals at hand.
class NormalSource {
 public:
  explicit NormalSource(const InstanceTable& table)
      : table_(table), computed_(normals_where_missing(table)) {}
  const std::vector<Vec3f>& of(std::uint32_t prototype) const {
    const TriangleMesh& given = *table_.prototypes[prototype];
    return given.normals.empty() ? computed_[prototype].normals : given.normals;
  }

 private:
  const InstanceTable& table_;
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

}  // namespace

void write_ply(const std::filesystem::path& path, const SceneView& scene, Job* job) {
  const InstanceTable empty;
  const InstanceTable& stones = scene.stones ? *scene.stones : empty;
  const std::uint64_t vertices = vertex_count(stones);
  if (vertices > std::numeric_limits<std::int32_t>::max())
    throw job_error(
        fmt::format("{}: {} vertices are more than a PLY face can name (2^31 - 1); "
                    "write instances as GLB",
                    path.string(), vertices));
  AtomicFile file(path);
  file.write(
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment Talus, metres, z up\n"
                  "element vertex {}\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "property float nx\nproperty float ny\nproperty float nz\n"
                  "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                  vertices, triangle_count(stones)));

  const NormalSource normals(stones);
  const std::size_t count = stones.instances.size();
  for (std::size_t i = 0; i < count; ++i) {
    report(job, "write PLY", i, 2 * count);
    const Instance& instance = stones.instances[i];
    const std::vector<Vec3f>& positions = stones.prototypes[instance.prototype]->positions;
    const std::vector<Vec3f>& local_normals = normals.of(instance.prototype);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      file.write_value(world_from_local(instance, positions[v]));
      file.write_value(Vec3f(instance.rotation * local_normals[v]));
    }
  }
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < count; ++i) {
    report(job, "write PLY", count + i, 2 * count);
    const TriangleMesh& mesh = *stones.prototypes[stones.instances[i].prototype];
    for (const Triangle& t : mesh.triangles) {
      file.write_value(std::uint8_t{3});
      file.write_value(t + first);
    }
    first += static_cast<std::uint32_t>(mesh.positions.size());
  }
  file.commit();
}

void write_obj(const std::filesystem::path& path, const SceneView& scene, Job* job) {
  const InstanceTable empty;
  const InstanceTable& stones = scene.stones ? *scene.stones : empty;
  AtomicFile file(path);
  file.write("# Talus, metres, y up\n");

  // One hundred-millionth of the scene, written out as decimals.
  const double longest = stones.instances.empty() ? 1 : bounds(stones).longest_side();
  const int decimals =
      std::clamp(8 - static_cast<int>(std::ceil(std::log10(std::max(longest, 1e-9)))), 0, 17);

  const NormalSource normals(stones);
  std::uint64_t first = 1;
  std::uint32_t run_prototype = 0, run_index = 0;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < stones.instances.size(); ++i) {
    report(job, "write OBJ", i, stones.instances.size());
    const Instance& instance = stones.instances[i];
    run_index = instance.prototype == run_prototype ? run_index : 0;
    run_prototype = instance.prototype;
    const TriangleMesh& mesh = *stones.prototypes[instance.prototype];
    text.clear();
    fmt::format_to(out, "o stones/{}/{}\n", instance.prototype, run_index++);
    for (const Vec3f& local : mesh.positions) {
      const Vec3 p = world_from_local(instance, local);
      fmt::format_to(out, "v {:.{}f} {:.{}f} {:.{}f}\n", p.x, decimals, p.z, decimals, -p.y,
                     decimals);
    }
    for (const Vec3f& local : normals.of(instance.prototype)) {
      const Vec3f n = instance.rotation * local;
      fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\n", n.x, n.z, -n.y);
    }
    for (const Triangle& t : mesh.triangles)
      fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", first + t.x, first + t.y, first + t.z);
    first += mesh.positions.size();
    file.write(std::string_view(text.data(), text.size()));
  }
  file.commit();
}

}  // namespace talus
