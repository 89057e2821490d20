#include "talus/tools/deposit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "tools/brush_scene.h"

namespace talus {
namespace {

using namespace test;

DepositParams random_params(std::uint64_t seed) {
  DepositParams params{.height = draw(seed, 20, 0.1, 2),
                       .profile = static_cast<DepositProfile>(pick(seed, 21, 4)),
                       .brush = {.radius = draw(seed, 22, 1, 6)}};
  if (seed % 3 == 0) {
    params.volume = draw(seed, 23, 1, 60);
    params.height.reset();
  }
  return params;
}

// Calls `use(x, y)` for each column that differs, and returns their number.
int for_each_change(const LayeredTerrain& before, const LayeredTerrain& after, auto&& use) {
  int count = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      if (!std::ranges::equal(before.column(x, y), after.column(x, y))) {
        ++count;
        use(x, y);
      }
  return count;
}

TEST(Deposit, LiesAsItsProfileSays) {
  const double radius = 5, height = 2;
  const auto thickness = [&](DepositProfile profile, int x, int y) {
    LayeredTerrain terrain = gallery();
    deposit(terrain, {.points = {{kMiddle, {}}}},
            {.height = height, .profile = profile, .brush = {.radius = radius}}, 1);
    return terrain.height_of(terrain.column(x, y).back().top());
  };
  for (const int x : {40, 43, 47, 49, 52}) {
    const double share = glm::length(axis(x, 32) - kMiddle) / radius;
    const double inside = share < 1 ? 1 : 0;
    EXPECT_NEAR(thickness(DepositProfile::constant, x, 32), inside * height, 0.0006) << x;
    EXPECT_NEAR(thickness(DepositProfile::cone, x, 32), inside * (1 - share) * height, 0.0006);
    EXPECT_NEAR(thickness(DepositProfile::dome, x, 32), inside * (1 - share * share) * height,
                0.0006);
    EXPECT_LE(thickness(DepositProfile::noise, x, 32),
              inside * (1 - share * share) * height + 6e-4);
  }
}

TEST(Deposit, OnlyNoiseFollowsTheSeed) {
  for (const DepositProfile profile : {DepositProfile::constant, DepositProfile::cone,
                                       DepositProfile::dome, DepositProfile::noise}) {
    const auto dropped = [&](std::uint64_t seed) {
      LayeredTerrain terrain = gallery();
      deposit(terrain, {.points = {{kMiddle, {}}}}, {.height = 1, .profile = profile}, seed);
      return terrain;
    };
    EXPECT_EQ(dropped(1), dropped(1));
    EXPECT_EQ(dropped(1) == dropped(2), profile != DepositProfile::noise);
  }
}

TEST(Deposit, ChangesNothingBeyondItsRadiusAndBooksAllOnAnyGround) {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LayeredTerrain before = stacks(seed);
    LayeredTerrain after = before;
    const BrushRegion region = random_stroke(seed);
    DepositParams params = random_params(seed);
    params.material = static_cast<Material>(pick(seed, 40, kMaterialCount - 1));
    params.remove = pick(seed, 41, 2);
    const Booking booking = deposit(after, region, params, seed);
    expect_booked(before, after, booking);
    expect_well_formed(after);
    for (int m = 0; m < kMaterialCount; ++m) {
      const auto material = static_cast<Material>(m);
      const bool named = material == params.material;
      EXPECT_TRUE(booking.added(material) == 0 || (named && !params.remove));
      EXPECT_TRUE(booking.removed(material) == 0 || (named && params.remove));
    }
    changed += for_each_change(before, after, [&](int x, int y) {
      ASSERT_LE(distance_to_stroke(region, axis(x, y)), params.brush.radius);
    });
  }
  EXPECT_GT(changed, 5000);
}

TEST(Deposit, TakesOnlyAirAboveASurfaceAndMovesNothingElse) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LayeredTerrain before = stacks(seed);
    LayeredTerrain after = before;
    DepositParams params = random_params(seed);
    params.material = Material::soil;
    deposit(after, random_stroke(seed), params, seed);
    for_each_change(before, after, [&](int x, int y) {
      for (Steps z = kGrid.floor; z < 16000; z += 137) {
        const Material was = before.material(x, y, z), is = after.material(x, y, z);
        if (was == is) continue;
        ASSERT_EQ(was, Material::air);
        ASSERT_EQ(is, Material::soil);
        Steps foot = z;
        while (before.material(x, y, foot) == Material::air &&
               after.material(x, y, foot) == Material::soil)
          --foot;
        ASSERT_NE(after.material(x, y, foot), Material::air) << "it lies on something";
      }
    });
  }
}

TEST(Deposit, UnderARoofStaysUnderItAndFillsNoMoreThanTheAir) {
  for (const double height : {0.4, 5.0}) {
    const LayeredTerrain before = gallery();
    LayeredTerrain after = before;
    deposit(after, {.points = {{kMiddle, -2.5}}},
            {.height = height, .profile = DepositProfile::constant, .brush = {.radius = 3}}, 1);
    const int changed = for_each_change(before, after, [&](int x, int y) {
      const Steps top = -3000 + static_cast<Steps>(std::min(1.0, height) * 1000);
      EXPECT_EQ(after.material(x, y, top - 1), Material::sand);
      EXPECT_EQ(after.material(x, y, -2001), height < 1 ? Material::air : Material::sand);
      EXPECT_EQ(after.material(x, y, -2000), Material::bedrock);
      EXPECT_EQ(after.column(x, y).back(), before.column(x, y).back());
    });
    EXPECT_NEAR(changed, 3.14159 * 6 * 6, 6);
  }
}

TEST(Deposit, FromWithinBedrockMovesNothing) {
  LayeredTerrain terrain = gallery();
  EXPECT_EQ(deposit(terrain, {.points = {{kMiddle, -1}}}, {.height = 1}, 1), Booking());
  EXPECT_TRUE(terrain == gallery());
}

TEST(Deposit, ComesOnTopOfTheLooseMatterThatItsPointLiesIn) {
  LayeredTerrain terrain = gallery();
  const BrushRegion region{.points = {{kMiddle, -2.9}}};
  const DepositParams params{.height = 0.25, .profile = DepositProfile::constant};
  for (int i = 1; i <= 5; ++i) {
    const Booking booking = deposit(terrain, region, params, 1);
    EXPECT_EQ(booking.added(Material::sand) > 0, i <= 4) << "four fill the gallery";
  }
  EXPECT_EQ(terrain.material(40, 32, -2001), Material::sand);
}

TEST(Deposit, RemovedWithTheSameBrushLeavesWhatWasThere) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    // Ground of bedrock and caves, on which no sand lies.
    LayeredTerrain before = stacks(seed);
    before.edit([&](int x, int y, ColumnEditor& column) {
      Steps bottom = kGrid.floor;
      for (const Layer& layer : before.column(x, y)) {
        if (layer.material() != Material::air)
          column.replace(bottom, layer.top(), Material::bedrock);
        bottom = layer.top();
      }
    });
    LayeredTerrain terrain = before;
    const BrushRegion region = random_stroke(seed);
    DepositParams params = random_params(seed);
    const Booking added = deposit(terrain, region, params, seed);
    EXPECT_GT(added.added(Material::sand), 0) << seed;
    params.remove = true;
    const Booking removed = deposit(terrain, region, params, seed);
    EXPECT_EQ(removed.removed(Material::sand), added.added(Material::sand)) << seed;
    EXPECT_TRUE(terrain == before) << seed;
  }
}

TEST(Deposit, RemovesOnlyWhatItNamesAndOnlyWhatShows) {
  LayeredTerrain terrain = gallery();
  terrain.edit([](int x, int, ColumnEditor& column) {
    column.replace(0, 500, Material::sand);
    if (x >= 40) column.replace(500, 600, Material::soil);
  });
  const Booking booking =
      deposit(terrain, {.points = {{kMiddle, {}}}},
              {.remove = true, .height = 0.8, .profile = DepositProfile::constant}, 1);
  EXPECT_GT(booking.removed(Material::sand), 0);
  EXPECT_EQ(booking.removed(Material::bedrock), 0);
  EXPECT_EQ(terrain.column(39, 32).back(), Layer(Material::bedrock, 0));
  EXPECT_EQ(terrain.column(40, 32).back(), Layer(Material::soil, 600))
      << "the sand below is hidden";
}

TEST(Deposit, OfAnyHeightFillsWhatThereIsRoomFor) {
  LayeredTerrain terrain = gallery();
  EXPECT_NO_THROW(
      deposit(terrain, {.points = {{kMiddle, {}}}}, {.height = 99'999, .brush = {.radius = 3}}, 1));
  EXPECT_FALSE(terrain == gallery());
}

TEST(Deposit, OfNoAmountChangesNothing) {
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    for (const bool by_volume : {false, true}) {
      const LayeredTerrain before = stacks(seed);
      LayeredTerrain terrain = before;
      DepositParams params;
      (by_volume ? params.volume : params.height) = 0;
      EXPECT_EQ(deposit(terrain, random_stroke(seed), params, seed), Booking());
      EXPECT_TRUE(terrain == before);
    }
}

TEST(Deposit, OfAVolumeIsThatVolumeToTheStep) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    LayeredTerrain terrain = stacks(seed);
    BrushRegion region = random_stroke(seed);
    for (SurfacePoint& point : region.points) point.z.reset();
    DepositParams params = random_params(seed);
    params.height.reset();
    params.volume = draw(seed, 50, 0.001, 400);
    const auto wanted = static_cast<std::int64_t>(std::llround(*params.volume / 0.25 / 0.001));
    EXPECT_EQ(steps_of_volume(kGrid, *params.volume), wanted);
    EXPECT_EQ(deposit(terrain, region, params, seed).added(Material::sand), wanted) << seed;
  }
}

TEST(Deposit, OfAVolumeRisesWhereARoofLeavesRoomThenStops) {
  // A gallery whose roof comes down to the east.
  LayeredTerrain before = gallery();
  before.edit([](int x, int, ColumnEditor& column) {
    column.replace(-2000 - 8 * x, -2000, Material::bedrock);
  });
  std::int64_t air = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      if (glm::length(axis(x, y) - kMiddle) < 4) air += 1000 - 8 * x;
  for (const double share : {0.3, 0.9, 0.999, 1.0, 1.5}) {
    LayeredTerrain terrain = before;
    const double volume = share * static_cast<double>(air) * 0.25 * 0.001;
    const Booking booking = deposit(terrain, {.points = {{kMiddle, -2.9}}}, {.volume = volume}, 1);
    EXPECT_EQ(booking.added(Material::sand), std::min(air, steps_of_volume(kGrid, volume)));
  }
}

TEST(Deposit, WithAMaskFollowsIt) {
  LayeredTerrain terrain = gallery();
  ColumnMask mask{.nx = kGrid.nx, .ny = kGrid.ny};
  for (int i = 0; i < kGrid.nx * kGrid.ny; ++i)
    mask.shares.push_back(static_cast<float>(pick(5, i, 3)) / 2);
  LayeredTerrain stroked = terrain;
  deposit(terrain, {.mask = mask}, {.height = 1}, 1);
  deposit(stroked, {.points = {{kMiddle, {}}}, .mask = mask},
          {.height = 1, .profile = DepositProfile::constant}, 1);
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x) {
      const Steps whole = 500 * pick(5, y * kGrid.nx + x, 3);
      const bool near = glm::length(axis(x, y) - kMiddle) < 4;
      ASSERT_EQ(terrain.column(x, y).back().top(), whole);
      ASSERT_EQ(stroked.column(x, y).back().top(), near ? whole : 0);
    }
}

TEST(Deposit, StampsAMapOfHeightsNorthUp) {
  // 7 m in the south-west, 9 m elsewhere.
  const HeightGrid map{.nx = 2, .ny = 2, .heights = {7, 9, 9, 9}};
  LayeredTerrain terrain = gallery();
  deposit(terrain, {.points = {{kMiddle, {}}}},
          {.height = 1, .profile = DepositProfile::map, .map = map}, 1);
  const auto top = [&](double x, double y) {
    return terrain.column(kGrid.column_x(kMiddle.x + x), kGrid.column_y(kMiddle.y + y))
        .back()
        .top();
  };
  EXPECT_EQ(top(-3.9, -3.9), 0);
  EXPECT_EQ(top(3.9, -3.9), 1000) << "also in the corner of the square";
  EXPECT_EQ(top(-3.9, 3.9), 1000);
  EXPECT_EQ(top(0.1, -3.9), 563) << "an axis a sixteenth of the radius east of the middle";
  EXPECT_EQ(top(4.1, 0), 0);
}

TEST(Deposit, IsTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    LayeredTerrain terrains[] = {stacks(seed), stacks(seed)};
    Booking bookings[2];
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      bookings[threads - 1] =
          deposit(terrains[threads - 1], random_stroke(seed), random_params(seed), seed);
    }
    EXPECT_TRUE(terrains[0] == terrains[1]);
    EXPECT_EQ(bookings[0], bookings[1]);
    EXPECT_FALSE(terrains[0] == stacks(seed));
  }
}

TEST(Deposit, RefusesWhatItCannotDoAndChangesNothing) {
  const LayeredTerrain before = gallery();
  LayeredTerrain terrain = before;
  const auto line = [&](const BrushRegion& region, const DepositParams& params) {
    try {
      deposit(terrain, region, params, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const BrushRegion middle{.points = {{kMiddle, {}}}};
  EXPECT_EQ(line({}, {.height = 1}),
            "deposit.points is empty, and there is no mask; give one of them");
  EXPECT_EQ(line(middle, {.height = 1, .brush = {.radius = -1}}),
            "deposit.radius = -1 m is out of range; it must be from 0.001 to 1000000 m");
  EXPECT_EQ(line(middle, {.height = std::nan("")}),
            "deposit.height = nan m is out of range; it must be from 0 to 100000 m");
  EXPECT_EQ(line(middle, {}),
            "deposit: how much is missing; write height = METRES or volume = CUBIC_METRES");
  EXPECT_EQ(line(middle, {.height = 1, .volume = 1}),
            "deposit: \"height\" and \"volume\" are both given; leave one of them out");
  EXPECT_EQ(
      line({.points = {{{1, 1}, 0.0}, {{1, 1}, 9'900'000.0}}},
           {.height = 1, .brush = {.radius = 1000, .spacing = 0.01}}),
      "deposit: 990001 dabs of 114 columns across are too much work; choose a larger spacing");
  EXPECT_EQ(line(middle, {.material = Material::air, .height = 1}),
            "deposit: \"material\" is air; to take matter away, name it and write remove = true");
  EXPECT_EQ(
      line({.points = {{{50, 10}, {}}}}, {.height = 1}),
      "deposit.points: (50, 10) is outside the terrain, which reaches from (0, 0) to (45, 35)");
  EXPECT_EQ(line({.points = {{{5, std::nan("")}, {}}}}, {.height = 1}),
            "deposit.points: a coordinate is no finite number");
  EXPECT_EQ(line({.points = {{{1, 1}, {}}, {{41, 1}, {}}}},
                 {.height = 1, .brush = {.radius = 1e-3, .spacing = 0.01}}),
            "deposit.points: a stroke of 40 m with a dab every 1e-05 m is more than 1000000 dabs; "
            "choose a larger spacing or radius");
  EXPECT_EQ(line({.mask = ColumnMask{.nx = 2, .ny = 1, .shares = {0, 1}}}, {.height = 1}),
            "deposit.mask has 2 x 1 pixels; it must have one for each column of the terrain, "
            "90 x 70");
  ColumnMask wrong{.nx = kGrid.nx, .ny = kGrid.ny};
  wrong.shares.assign(static_cast<std::size_t>(kGrid.nx) * kGrid.ny, std::nanf(""));
  EXPECT_EQ(line({.mask = wrong}, {.height = 1}),
            "deposit.mask must have a share from 0 to 1 for each pixel");
  const auto map_line = [&](const HeightGrid& map) {
    return line(middle, {.height = 1, .profile = DepositProfile::map, .map = map});
  };
  const HeightGrid wrong_maps[] = {{},
                                   {.nx = 2, .ny = 1, .heights = {1, 1}},
                                   {.nx = 2, .ny = 1, .heights = {1, std::nanf("")}},
                                   {.nx = 2, .ny = 1, .heights = {1, HUGE_VALF}},
                                   {.nx = 2, .ny = 2, .heights = {1, 2, 3}}};
  for (const HeightGrid& map : wrong_maps)
    EXPECT_EQ(map_line(map),
              "deposit.map must have known heights of which one is higher than another");
  EXPECT_EQ(line({.mask = wrong}, {.height = 1, .profile = DepositProfile::map}),
            "deposit.profile is a map, which needs dabs; give points");
  EXPECT_TRUE(terrain == before);
}

}  // namespace
}  // namespace talus
