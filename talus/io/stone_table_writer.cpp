#include "talus/io/stone_table_writer.h"

#include <string_view>

#include "talus/io/print.h"

namespace talus {
namespace {

constexpr std::size_t kProgressRows = 4096;

template <class Row>
void for_rows(const InstanceTable& stones, std::string_view stage, Job* job, Row&& row) {
  const std::size_t count = stones.instances.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kProgressRows == 0)
      report_progress(job, stage, static_cast<double>(i) / static_cast<double>(count));
    row(stones.instances[i]);
  }
}

}  // namespace

void write_points(const std::filesystem::path& path, const InstanceTable& stones, Job* job) {
  AtomicFile file(path);
  print(file,
        "ply\nformat binary_little_endian 1.0\ncomment Talus, stones, metres, z up\n"
        "element vertex {}\n"
        "property double x\nproperty double y\nproperty double z\n"
        "property float qx\nproperty float qy\nproperty float qz\nproperty float qw\n"
        "property float scale\nproperty uint shape\n"
        "property int cell_x\nproperty int cell_y\nproperty int cell_z\n"
        "property ushort seed\nproperty ushort pile\nend_header\n",
        stones.instances.size());
  for_rows(stones, "write points", job, [&](const Instance& stone) {
    file.write_value(stone.position);
    for (const float x :
         {stone.rotation.x, stone.rotation.y, stone.rotation.z, stone.rotation.w, stone.scale})
      file.write_value(x);
    file.write_value(stone.prototype);
    for (const int x : {stone.name.cell.x, stone.name.cell.y, stone.name.cell.z})
      file.write_value(x);
    file.write_value(stone.name.seed);
    file.write_value(stone.name.pile);
  });
  file.commit();
}

void write_csv(const std::filesystem::path& path, const InstanceTable& stones, Job* job) {
  AtomicFile file(path);
  file.write("x,y,z,qx,qy,qz,qw,scale,shape,cell_x,cell_y,cell_z,seed,pile\n");
  for_rows(stones, "write CSV", job, [&](const Instance& stone) {
    const Vec3& p = stone.position;
    const Quat& q = stone.rotation;
    const InstanceName& name = stone.name;
    print(file, "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", p.x, p.y, p.z, q.x, q.y, q.z, q.w,
          stone.scale, stone.prototype, name.cell.x, name.cell.y, name.cell.z, name.seed,
          name.pile);
  });
  file.commit();
}

}  // namespace talus
