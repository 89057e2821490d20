#include "talus/io/stone_table_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "io/scenes.h"
#include "io/scratch.h"

namespace talus {
namespace {

using test::bytes_of;
using test::heap;
using test::Scratch;

void expect_equal(const Instance& read, const Instance& expected) {
  EXPECT_EQ(read.position, expected.position);
  EXPECT_EQ(read.rotation, expected.rotation);
  EXPECT_EQ(read.scale, expected.scale);
  EXPECT_EQ(read.prototype, expected.prototype);
  EXPECT_EQ(read.name.cell, expected.name.cell);
  EXPECT_EQ(read.name.seed, expected.name.seed);
  EXPECT_EQ(read.name.pile, expected.name.pile);
}

// A heap whose stones have names, some of them with large numbers.
InstanceTable named_heap() {
  InstanceTable stones = heap(100, {500'000, 5'000'000, 1500});
  for (int i = 0; i < 100; ++i)
    stones.instances[static_cast<std::size_t>(i)].name = {
        .cell = {i * 1'000'003, -i, 7 * i - 300},
        .seed = static_cast<std::uint16_t>(i % 20),
        .pile = static_cast<std::uint16_t>(655 * i)};
  return stones;
}

template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

TEST(StoneTables, PointsReadBackToTheBit) {
  const Scratch scratch;
  const InstanceTable stones = named_heap();
  write_points(scratch.path("stones.ply"), stones);
  const std::string file = bytes_of(scratch.path("stones.ply"));
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment Talus, stones, metres, z up\n"
      "element vertex 100\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float qx\nproperty float qy\nproperty float qz\nproperty float qw\n"
      "property float scale\nproperty uint shape\n"
      "property int cell_x\nproperty int cell_y\nproperty int cell_z\n"
      "property ushort seed\nproperty ushort pile\nend_header\n";
  ASSERT_TRUE(file.starts_with(header));
  std::string_view rows = std::string_view(file).substr(header.size());
  ASSERT_EQ(rows.size(), 100u * (3 * 8 + 6 * 4 + 3 * 4 + 2 * 2));
  for (const Instance& expected : stones.instances) {
    Instance read{.position = take<Vec3>(rows)};
    const auto [x, y, z, w] = take<std::array<float, 4>>(rows);
    read.rotation = Quat(w, x, y, z);
    read.scale = take<float>(rows);
    read.prototype = take<std::uint32_t>(rows);
    read.name.cell = take<Int3>(rows);
    read.name.seed = take<std::uint16_t>(rows);
    read.name.pile = take<std::uint16_t>(rows);
    expect_equal(read, expected);
  }
}

TEST(StoneTables, CsvReadsBackToTheBit) {
  const Scratch scratch;
  const InstanceTable stones = named_heap();
  write_csv(scratch.path("stones.csv"), stones);
  std::istringstream lines(bytes_of(scratch.path("stones.csv")));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "x,y,z,qx,qy,qz,qw,scale,shape,cell_x,cell_y,cell_z,seed,pile");
  for (const Instance& expected : stones.instances) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    std::vector<std::string> c;
    for (std::string cell; std::getline(cells, cell, ',');) c.push_back(cell);
    ASSERT_EQ(c.size(), 14u);
    expect_equal({.position = {std::stod(c[0]), std::stod(c[1]), std::stod(c[2])},
                  .rotation = {std::stof(c[6]), std::stof(c[3]), std::stof(c[4]), std::stof(c[5])},
                  .scale = std::stof(c[7]),
                  .prototype = static_cast<std::uint32_t>(std::stoul(c[8])),
                  .name = {.cell = {std::stoi(c[9]), std::stoi(c[10]), std::stoi(c[11])},
                           .seed = static_cast<std::uint16_t>(std::stoi(c[12])),
                           .pile = static_cast<std::uint16_t>(std::stoi(c[13]))}},
                 expected);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(StoneTables, OfNoStonesHaveNoRows) {
  const Scratch scratch;
  write_csv(scratch.path("stones.csv"), {});
  EXPECT_EQ(bytes_of(scratch.path("stones.csv")),
            "x,y,z,qx,qy,qz,qw,scale,shape,cell_x,cell_y,cell_z,seed,pile\n");
  write_points(scratch.path("stones.ply"), {});
  EXPECT_TRUE(bytes_of(scratch.path("stones.ply")).ends_with("end_header\n"));
}

TEST(StoneTables, ACancelledJobLeavesNothing) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  Job job;
  job.cancel();
  EXPECT_THROW(write_csv(scratch.path("stones.csv"), stones, &job), Cancelled);
  EXPECT_THROW(write_points(scratch.path("stones.ply"), stones, &job), Cancelled);
  EXPECT_EQ(scratch.file_count(), 0u);
}

}  // namespace
}  // namespace talus
