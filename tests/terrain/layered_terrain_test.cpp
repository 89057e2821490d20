#include "talus/terrain/layered_terrain.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>

#include "talus/base/parallel.h"
#include "terrain/cave_scene.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::pick;
using test::random_stacks;
using test::sum;

constexpr Steps kHeight = 60;

TerrainGrid small_grid(std::uint64_t seed) {
  return {.nx = 1 + pick(seed, 100, 70),
          .ny = 1 + pick(seed, 101, 4),
          .cell = 0.5,
          .step = 0.25,
          .origin_x = -3,
          .origin_y = 7,
          .floor = pick(seed, 102, 21) - 10};
}

TEST(Layer, HoldsEveryMaterialAtEveryHeight) {
  for (int m = 0; m < kMaterialCount; ++m)
    for (const Steps top : {-kStepsMax, -1, 0, 1, kStepsMax}) {
      const Layer layer(static_cast<Material>(m), top);
      EXPECT_EQ(layer.material(), static_cast<Material>(m));
      EXPECT_EQ(layer.top(), top);
    }
}

RC_GTEST_PROP(LayeredTerrain, ReplacingEqualsAModelOfVoxels, (std::uint64_t seed)) {
  const TerrainGrid grid = small_grid(seed);
  LayeredTerrain terrain(grid);
  test::Voxels voxels(grid, kHeight);
  for (int i = 0; i < 12; ++i) {
    const std::uint64_t turn = hash(seed, Purpose::texture, i);
    const int x = pick(turn, 0, grid.nx) - 1, y = pick(turn, 1, grid.ny) - 1;
    const ColumnArea area{x, y, x + pick(turn, 2, 40), y + pick(turn, 3, 4)};
    const Steps bottom = grid.floor - 3 + pick(turn, 4, kHeight - 15);
    const Steps top = bottom + pick(turn, 5, 15);
    const auto material = static_cast<Material>(pick(turn, 6, kMaterialCount));

    const MaterialSteps before = terrain.volume();
    const Booking booking = terrain.edit(
        area, [&](int, int, ColumnEditor& column) { column.replace(bottom, top, material); });
    test::expect_well_formed(terrain);

    Booking expected;
    for (int cy = 0; cy < grid.ny; ++cy)
      for (int cx = 0; cx < grid.nx; ++cx)
        for (Steps z = std::max(bottom, grid.floor); z < top; ++z)
          if (area.contains(cx, cy)) {
            expected.replace(voxels.at(cx, cy, z), material, 1);
            voxels.at(cx, cy, z) = material;
          }
    RC_ASSERT(booking == expected);
    RC_ASSERT(sum(before, booking.change()) == terrain.volume());
    RC_ASSERT(terrain.volume() == voxels.volume());
  }
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x)
      for (Steps z = grid.floor; z < grid.floor + kHeight; ++z)
        RC_ASSERT(terrain.material(x, y, z) == voxels.at(x, y, z));
}

RC_GTEST_PROP(LayeredTerrain, AnswersForPointsAsForTheirSteps, (std::uint64_t seed)) {
  const TerrainGrid grid = small_grid(seed);
  const LayeredTerrain terrain = random_stacks(seed, grid);
  for (int i = 0; i < 200; ++i) {
    const int x = pick(seed, 3 * i, grid.nx + 4) - 2, y = pick(seed, 3 * i + 1, grid.ny + 4) - 2;
    const Steps z = grid.floor + pick(seed, 3 * i + 2, 110) - 10;
    const Vec3 inside(uniform(hash(seed, Purpose::texture, i, 0)),
                      uniform(hash(seed, Purpose::texture, i, 1)),
                      uniform(hash(seed, Purpose::texture, i, 2)));
    const Vec3 p(grid.origin_x + (x + inside.x) * grid.cell,
                 grid.origin_y + (y + inside.y) * grid.cell, (z + inside.z) * grid.step);
    RC_ASSERT(terrain.material(p) == terrain.material(x, y, z));
  }
}

TEST(LayeredTerrain, IsAirAroundAndAboveAndBedrockBelow) {
  LayeredTerrain terrain({.nx = 3, .ny = 2, .floor = 5});
  EXPECT_TRUE(terrain.column(1, 1).empty());
  EXPECT_EQ(terrain.material(1, 1, 4), Material::bedrock);
  EXPECT_EQ(terrain.material(1, 1, 5), Material::air);
  EXPECT_EQ(terrain.material(-1, 1, 4), Material::air);
  EXPECT_EQ(terrain.material(1, 2, 4), Material::air);
  EXPECT_EQ(terrain.material({1.5, 1.5, -1e30}), Material::bedrock);
  EXPECT_EQ(terrain.material({1.5, 1.5, 1e30}), Material::air);
  EXPECT_EQ(terrain.material({-1e30, 1.5, -1e30}), Material::air);
  EXPECT_EQ(terrain.material({std::nan(""), 1.5, -1}), Material::air);

  // What lies below the floor stays, and is not booked.
  const Booking booking =
      terrain.edit([](int, int, ColumnEditor& column) { column.replace(-20, 8, Material::water); });
  EXPECT_EQ(booking.added(Material::water), 3 * 6);
  EXPECT_EQ(terrain.material(1, 1, 4), Material::bedrock);
}

TEST(LayeredTerrain, CopiesShareTilesUntilOneIsEdited) {
  const LayeredTerrain original = random_stacks(1, {.nx = 130, .ny = 70});
  LayeredTerrain copy = original;
  copy.edit({0, 0, 1, 1}, [](int, int, ColumnEditor& c) { c.replace(0, 90, Material::ice); });
  EXPECT_EQ(original, random_stacks(1, {.nx = 130, .ny = 70}));
  EXPECT_NE(copy, original);
  EXPECT_NE(copy.column(0, 0).data(), original.column(0, 0).data());
  EXPECT_EQ(copy.column(64, 0).data(), original.column(64, 0).data());
  EXPECT_EQ(copy.column(129, 69).data(), original.column(129, 69).data());
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 130; ++x)
      ASSERT_TRUE(x + y == 0 || std::ranges::equal(copy.column(x, y), original.column(x, y)));

  // A change that changes nothing packs nothing.
  LayeredTerrain same = original;
  same.edit([](int, int, ColumnEditor&) {});
  EXPECT_EQ(same.column(0, 0).data(), original.column(0, 0).data());
}

TEST(LayeredTerrain, IsTheSameForAnyNumberOfThreads) {
  const auto made_by = [](int threads) {
    const ThreadLimit limit(threads);
    LayeredTerrain terrain = random_stacks(3, {.nx = 200, .ny = 150});
    const Booking booking = terrain.edit([](int x, int y, ColumnEditor& c) {
      c.replace(x % 17, x % 17 + y % 13, static_cast<Material>((x + y) % kMaterialCount));
    });
    return std::pair(terrain, booking);
  };
  EXPECT_EQ(made_by(1), made_by(2));
}

TEST(LayeredTerrain, FailedAndCancelledEditsChangeNothing) {
  const LayeredTerrain original = random_stacks(4, {.nx = 150, .ny = 70});
  LayeredTerrain terrain = original;
  EXPECT_THROW(terrain.edit([](int x, int y, ColumnEditor& c) {
    c.replace(0, 50, Material::sand);
    if (x == 140 && y == 60) c.replace(0, kStepsMax + 1, Material::sand);
  }),
               Error);
  EXPECT_EQ(terrain, original);

  Job job;
  const auto cancel_midway = [&](int x, int, ColumnEditor& c) {
    c.replace(0, 50, Material::sand);
    if (x == 30) job.cancel();
  };
  EXPECT_THROW(terrain.edit(cancel_midway, &job), Cancelled);
  EXPECT_EQ(terrain, original);
}

TEST(LayeredTerrain, AChangeSeesTheTerrainAsItWas) {
  LayeredTerrain terrain = random_stacks(5, {.nx = 100, .ny = 20});
  const LayeredTerrain original = terrain;
  terrain.edit([&](int x, int y, ColumnEditor& c) {
    const auto west = terrain.column(std::max(x - 1, 0), y);
    c.replace(0, 100, Material::air);
    c.replace(0, west.empty() ? 0 : west.back().top(), Material::soil);
  });
  for (int x = 1; x < 100; ++x) {
    const auto west = original.column(x - 1, 7);
    const auto now = terrain.column(x, 7);
    ASSERT_EQ(now.size(), west.empty() ? 0u : 1u);
    ASSERT_TRUE(west.empty() || now.back() == Layer(Material::soil, west.back().top()));
  }
}

TEST(LayeredTerrain, TilesOfManyLayersAreHeldToo) {
  LayeredTerrain terrain({.nx = 65, .ny = 64});
  const auto stripes = [](int, int, ColumnEditor& c) {
    for (Steps z = 0; z < 40; ++z)
      c.replace(z, z + 1, z % 2 == 0 ? Material::sand : Material::soil);
  };
  terrain.edit(stripes);
  EXPECT_EQ(terrain.layer_count(), 65u * 64 * 40);
  for (const int x : {0, 31, 63, 64})
    for (Steps z = 0; z < 40; ++z)
      ASSERT_EQ(terrain.material(x, 63, z), z % 2 == 0 ? Material::sand : Material::soil);
  terrain.edit([](int, int, ColumnEditor& c) { c.replace(0, 40, Material::ice); });
  EXPECT_EQ(terrain.layer_count(), 65u * 64);
}

TEST(LayeredTerrain, TakesFourBytesALayerAndLittleAColumn) {
  const LayeredTerrain terrain = test::cave_scene(256, 200);
  const auto layers = static_cast<double>(terrain.layer_count());
  const auto columns = static_cast<double>(terrain.column_count());
  EXPECT_EQ(columns, 256 * 200);
  EXPECT_GT(layers, 3 * columns);
  EXPECT_LT(static_cast<double>(terrain.bytes()), 4 * layers + 2.4 * columns);
  EXPECT_GT(static_cast<double>(terrain.bytes()), 4 * layers + 2 * columns);
}

TEST(LayeredTerrain, ColumnsAreEditedRowByRowWithinATile) {
  LayeredTerrain terrain({.nx = 100, .ny = 100});
  std::array<std::vector<std::pair<int, int>>, 4> seen;
  terrain.edit([&](int x, int y, ColumnEditor&) {
    seen[static_cast<std::size_t>(x / 64 + 2 * (y / 64))].emplace_back(y, x);
  });
  for (const auto& columns : seen) {
    EXPECT_FALSE(columns.empty());
    EXPECT_TRUE(std::is_sorted(columns.begin(), columns.end()));
  }
}

TEST(LayeredTerrain, EditsTouchOnlyTheirArea) {
  LayeredTerrain terrain({.nx = 100, .ny = 100});
  std::atomic<int> calls = 0;
  terrain.edit({-5, 60, 70, 70}, [&](int, int, ColumnEditor& c) {
    ++calls;
    c.replace(0, 1, Material::sand);
  });
  EXPECT_EQ(calls, 70 * 10);
  EXPECT_EQ(terrain.layer_count(), 700u);
  terrain.edit({200, 0, 300, 10}, [&](int, int, ColumnEditor&) { ++calls; });
  terrain.edit({20, 10, 20, 30}, [&](int, int, ColumnEditor&) { ++calls; });
  EXPECT_EQ(calls, 70 * 10);
}

TEST(LayeredTerrain, RearrangingBooksOnlyConversions) {
  LayeredTerrain terrain({});
  terrain.edit([](int, int, ColumnEditor& c) {
    c.replace(0, 10, Material::snow);
    c.replace(10, 12, Material::sand);
  });
  const MaterialSteps before = terrain.volume();
  const Booking booking = terrain.edit([](int, int, ColumnEditor& c) {
    const std::array layers = {Layer(Material::sand, 2), Layer(Material::water, 5)};
    const std::array conversions = {Conversion{Material::snow, Material::water, 10, 3}};
    c.rearrange(layers, conversions);
  });
  EXPECT_EQ(booking.replaced(Material::snow, Material::water), 10);
  EXPECT_EQ(booking.conversion(Material::snow, Material::water).to_steps, 3);
  EXPECT_EQ(booking.added(Material::sand), 0);
  EXPECT_EQ(sum(before, booking.change()), terrain.volume());
  EXPECT_EQ(terrain.volume()[static_cast<std::size_t>(Material::water)], 3);
}

TEST(LayeredTerrain, RefusesGridsAndHeightsThatCannotBe) {
  EXPECT_THROW(LayeredTerrain({.nx = 0}), Error);
  EXPECT_THROW(LayeredTerrain({.ny = -3}), Error);
  EXPECT_THROW(LayeredTerrain({.nx = 40000, .ny = 40000}), Error);
  EXPECT_THROW(LayeredTerrain({.nx = 2147483647, .ny = 2147483647}), Error);
  EXPECT_THROW(LayeredTerrain({.cell = 0}), Error);
  EXPECT_THROW(LayeredTerrain({.step = std::nan("")}), Error);
  EXPECT_THROW(LayeredTerrain({.origin_x = INFINITY}), Error);
  EXPECT_THROW(LayeredTerrain({.floor = kStepsMax + 1}), Error);

  const LayeredTerrain terrain({.step = 0.5});
  EXPECT_EQ(terrain.nearest_step(2.3), 5);
  EXPECT_EQ(terrain.nearest_step(-2.3), -5);
  EXPECT_EQ(terrain.height_of(terrain.nearest_step(1000.5)), 1000.5);
  EXPECT_THROW(terrain.nearest_step(1e9), Error);
  EXPECT_THROW(terrain.nearest_step(std::nan("")), Error);
}

TEST(Booking, AddsUpInAnyOrder) {
  Booking a, b;
  a.replace(Material::air, Material::sand, 7);
  a.replace(Material::sand, Material::sand, 5);
  b.convert({Material::water, Material::ice, 917, 1000});
  Booking ab = a, ba = b;
  ab.add(b);
  ba.add(a);
  EXPECT_EQ(ab, ba);
  EXPECT_EQ(ab.added(Material::sand), 7);
  MaterialSteps change{};
  change[static_cast<std::size_t>(Material::sand)] = 7;
  change[static_cast<std::size_t>(Material::water)] = -917;
  change[static_cast<std::size_t>(Material::ice)] = 1000;
  EXPECT_EQ(ab.change(), change);
}

TEST(Material, TableFollowsTheNumbers) {
  ASSERT_EQ(material_infos().size(), static_cast<std::size_t>(kMaterialCount));
  EXPECT_EQ(material_info(Material::bedrock).name, "bedrock");
  EXPECT_EQ(material_info(Material::rocks).kind, MaterialKind::granular);
  EXPECT_EQ(material_info(Material::water).kind, MaterialKind::liquid);
  EXPECT_EQ(material_info(Material::air).kind, MaterialKind::empty);
  for (const MaterialInfo& info : material_infos()) EXPECT_GT(info.density, 0) << info.name;
}

}  // namespace
}  // namespace talus
