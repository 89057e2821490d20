#include "talus/io/instance_cells.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "talus/base/hash.h"

namespace talus {
namespace {

// Stones of `meshes` meshes by chance in a box of `size`.
InstanceTable strewn(std::size_t count, std::size_t meshes, const Vec3& size, std::uint64_t seed) {
  InstanceTable table;
  table.prototypes.assign(meshes, std::make_shared<TriangleMesh>());
  for (std::size_t i = 0; i < count; ++i) {
    const auto chance = [&](int what) { return uniform(hash(seed, Purpose::texture, i, what)); };
    table.instances.push_back({.position = size * Vec3(chance(0), chance(1), chance(2)),
                               .prototype = static_cast<std::uint32_t>(meshes * i / count)});
  }
  return table;
}

RC_GTEST_PROP(InstanceCells, HoldEveryInstanceOnceInRunsOfItsPrototype, ()) {
  const auto meshes = *rc::gen::inRange<std::size_t>(1, 40);
  const auto count = *rc::gen::inRange<std::size_t>(meshes, 60'000);
  const Vec3 size(*rc::gen::inRange(0, 100), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 100));
  const InstanceTable table = strewn(count, meshes, size, *rc::gen::arbitrary<std::uint64_t>());
  const InstanceCells cells = split_into_cells(table);

  std::vector<bool> met(count, false);
  std::size_t next = 0;
  for (const InstanceCell& cell : cells.cells) {
    RC_ASSERT(!cell.runs.empty());
    for (std::size_t r = 0; r < cell.runs.size(); ++r) {
      const InstanceRun& run = cell.runs[r];
      RC_ASSERT(r == 0 || cell.runs[r - 1].prototype < run.prototype);
      RC_ASSERT(run.first == next && run.count > 0);
      for (; next < run.first + run.count; ++next) {
        const std::uint32_t i = cells.order[next];
        RC_ASSERT(next == run.first || cells.order[next - 1] < i);
        RC_ASSERT(!met[i]);
        met[i] = true;
        RC_ASSERT(table.instances[i].prototype == run.prototype);
        RC_ASSERT(cell.positions.contains(table.instances[i].position));
      }
    }
  }
  RC_ASSERT(next == count);
}

RC_GTEST_PROP(InstanceCells, AreNoneTooSmallWhereThereAreSeveral, ()) {
  const auto meshes = *rc::gen::inRange<std::size_t>(1, 200);
  const auto count = *rc::gen::inRange<std::size_t>(10'000, 60'000);
  const InstanceCells cells = split_into_cells(strewn(count, meshes, Vec3(9, 5, 2), 1));
  for (const InstanceCell& cell : cells.cells) {
    std::size_t instances = 0;
    for (const InstanceRun& run : cell.runs) instances += run.count;
    RC_ASSERT(cells.cells.size() == 1 || instances >= 4096);
    RC_ASSERT(cells.cells.size() == 1 || instances >= 64 * cell.runs.size());
  }
}

TEST(InstanceCells, DoNotOverlapInsideACloud) {
  const InstanceCells cells = split_into_cells(strewn(100'000, 10, Vec3(40, 40, 3), 7));
  EXPECT_EQ(cells.cells.size(), 16u);
  for (const InstanceCell& a : cells.cells)
    for (const InstanceCell& b : cells.cells) {
      const Vec3 low = glm::max(a.positions.min, b.positions.min);
      const Vec3 high = glm::min(a.positions.max, b.positions.max);
      EXPECT_TRUE(&a == &b || low.x >= high.x || low.y >= high.y || low.z >= high.z);
    }
}

TEST(InstanceCells, OfNothingAreNone) {
  EXPECT_TRUE(split_into_cells({}).cells.empty());
  EXPECT_TRUE(split_into_cells({}).order.empty());
}

TEST(InstanceCells, KeepSmallPilesWhole) {
  EXPECT_EQ(split_into_cells(strewn(8'000, 3, Vec3(100), 1)).cells.size(), 1u);
}

}  // namespace
}  // namespace talus
