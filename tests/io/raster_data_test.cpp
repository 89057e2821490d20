// Real elevation data, held against what GDAL's own warper makes of it in a process of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "io/scratch.h"
#include "talus/base/hash.h"
#include "talus/io/raster_reader.h"
#include "test_data.h"

namespace talus {
namespace {

using test::Scratch;

// What is known of a file: sizes hold for those that are kept cell by cell.
struct Dem {
  const char* name;
  int nx = 0;
  int ny = 0;
  double cell;
  double lowest;
  double highest;
  std::size_t unknown = 0;
};
constexpr Dem kKept[] = {
    {"besseggen_10m_utm32.tif", 256, 256, 10, 981.8, 1905.4},
    {"avaGar_5m_mgi.asc", 520, 387, 4.997678, 1234, 2676, 82'888},
    {"redbutte_26m_utm12.tif", 260, 268, 26.477018, 1580, 2520, 37'948},
    {"mtsthelens1980_30m_utm10.dem", 327, 468, 30, 682, 2543, 4'151},
};
// Resampled: the spacing is that of the pixels on the ground.
constexpr Dem kProjected[] = {
    {"N46E010.hgt", 0, 0, 77, 137, 3865},
    {"N42E001.hgt", 0, 0, 79.6, 349, 3100},
    {"stelvio_u16_metres.png", 0, 0, 77, 137, 3865},
    {"davos_srtm1_2048.tif", 0, 0, 25.6, 556, 3373},
    {"grandcanyon_76m_epsg3857.tif", 0, 0, 61.7, 479, 2347},
    {"saxonswitzerland_z11_epsg3857.tif", 0, 0, 24.1, 112.6, 560.2},
};

std::filesystem::path dem_folder() { return std::filesystem::path(TALUS_TEST_DATA_DIR) / "dem"; }

struct Extremes {
  float lowest = HUGE_VALF;
  float highest = -HUGE_VALF;
  std::size_t unknown = 0;
};
Extremes extremes_of(const HeightGrid& grid) {
  Extremes found;
  for (const float z : grid.heights) {
    if (std::isnan(z)) {
      ++found.unknown;
      continue;
    }
    found.lowest = std::min(found.lowest, z);
    found.highest = std::max(found.highest, z);
  }
  return found;
}

TEST(RasterData, KeepsMetricRastersCellByCell) {
  NEEDS_TEST_DATA();
  for (const Dem& dem : kKept) {
    const ReadRasterResult read = read_raster(dem_folder() / dem.name, {.holes = HoleMode::keep});
    EXPECT_EQ(read.grid.nx, dem.nx) << dem.name;
    EXPECT_EQ(read.grid.ny, dem.ny) << dem.name;
    EXPECT_NEAR(read.grid.cell, dem.cell, 1e-6) << dem.name;
    EXPECT_EQ(read.unknown_cells, dem.unknown) << dem.name;
    EXPECT_TRUE(read.warnings.empty()) << dem.name;
    EXPECT_FALSE(read.georeference.crs.empty()) << dem.name;
    const Extremes found = extremes_of(read.grid);
    EXPECT_NEAR(found.lowest, dem.lowest, 0.5) << dem.name;
    EXPECT_NEAR(found.highest, dem.highest, 0.5) << dem.name;
    EXPECT_EQ(found.unknown, dem.unknown) << dem.name;
  }
}

TEST(RasterData, LaysOthersOutInMetres) {
  NEEDS_TEST_DATA();
  for (const Dem& dem : kProjected) {
    const ReadRasterResult read = read_raster(dem_folder() / dem.name);
    EXPECT_TRUE(read.georeference.crs.starts_with("EPSG:326")) << read.georeference.crs;
    EXPECT_NEAR(read.grid.cell, dem.cell, 0.1) << dem.name;
    // Cubic interpolation may pass the highest and lowest pixels a little.
    const Extremes found = extremes_of(read.grid);
    EXPECT_NEAR(found.lowest, dem.lowest, 10) << dem.name;
    EXPECT_NEAR(found.highest, dem.highest, 10) << dem.name;
    EXPECT_EQ(found.unknown, 0u) << dem.name;
  }
}

// Heights of the frame's cells by the command-line tool, rows from the north; empty if it fails.
std::vector<float> warped(const Scratch& scratch, const std::filesystem::path& path,
                          const ReadRasterResult& read, const char* kernel) {
  const HeightGrid& grid = read.grid;
  const Vec2 corner = read.georeference.offset;
  const std::string source_crs = path.extension() == ".png" ? "-s_srs EPSG:4326" : "";
  const std::string command = fmt::format(
      "gdalwarp -q -overwrite -et 0 -r {} -ot Float32 -of ENVI -dstnodata nan {} -t_srs '{}' "
      "-te {:.17g} {:.17g} {:.17g} {:.17g} -ts {} {} '{}' '{}'",
      kernel, source_crs, read.georeference.crs, corner.x, corner.y, corner.x + grid.cell * grid.nx,
      corner.y + grid.cell * grid.ny, grid.nx, grid.ny, path.string(),
      scratch.path("warped.bin").string());
  if (std::system(command.c_str()) != 0) return {};
  const std::string bytes = test::bytes_of(scratch.path("warped.bin"));
  std::vector<float> heights(bytes.size() / sizeof(float));
  std::memcpy(heights.data(), bytes.data(), heights.size() * sizeof(float));
  return heights;
}

void expect_as_gdalwarp(const std::filesystem::path& path, const ReadRasterParams& params,
                        const char* kernel) {
  const Scratch scratch;
  const ReadRasterResult read = read_raster(path, params);
  const HeightGrid& grid = read.grid;
  const std::vector<float> expected = warped(scratch, path, read, kernel);
  ASSERT_EQ(expected.size(), grid.heights.size()) << path;
  const auto expected_at = [&](int x, int y) { return expected[grid.index(x, grid.ny - 1 - y)]; };

  for (int i = 0; i < 1000; ++i) {
    const auto chance = [&](int what, int count) {
      return static_cast<int>(hash(1, Purpose::texture, i, what) % static_cast<unsigned>(count));
    };
    const int x = chance(0, grid.nx), y = chance(1, grid.ny);
    const float height = grid.heights[grid.index(x, y)];
    if (std::isnan(expected_at(x, y)))
      EXPECT_TRUE(std::isnan(height)) << path << " " << x << ", " << y;
    else
      EXPECT_NEAR(height, expected_at(x, y), 1e-3) << path << " " << x << ", " << y;
  }
  // Holes are where they were.
  std::size_t moved = 0;
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x)
      moved += std::isnan(grid.heights[grid.index(x, y)]) != std::isnan(expected_at(x, y));
  EXPECT_EQ(moved, 0u) << path;
}

TEST(RasterData, EqualsGdalwarp) {
  NEEDS_TEST_DATA();
  ASSERT_EQ(std::system("gdalwarp --version > /dev/null 2>&1"), 0)
      << "the set-up installs gdalwarp";
  for (const Dem& dem : kProjected)
    expect_as_gdalwarp(dem_folder() / dem.name, {.holes = HoleMode::keep}, "cubic");
  for (const Dem& dem : kKept) {
    expect_as_gdalwarp(dem_folder() / dem.name, {.holes = HoleMode::keep}, "near");
    expect_as_gdalwarp(
        dem_folder() / dem.name,
        {.cell = 1.7 * dem.cell, .resampling = Resampling::bilinear, .holes = HoleMode::keep},
        "bilinear");
  }
}

TEST(RasterData, ReadsAPartAsIfItWereTheWhole) {
  // Around the Stelvio pass; the part's own pixels reach no further than the kernel.
  NEEDS_TEST_DATA();
  const ReadRasterParams params{.crop = Box2{{10.4, 46.5}, {10.5, 46.56}}, .cell = 80};
  const HeightGrid part = read_raster(dem_folder() / "N46E010.hgt", params).grid;
  EXPECT_NEAR(part.nx * part.cell, 0.1 * 111'320 * std::cos(0.812), 200);
  EXPECT_NEAR(part.ny * part.cell, 0.06 * 111'200, 200);
  const Extremes found = extremes_of(part);
  EXPECT_GT(found.lowest, 1200);
  EXPECT_GT(found.highest, 3300);
}

TEST(RasterData, SurvivesEveryTruncation) {
  NEEDS_TEST_DATA();
  const Scratch scratch;
  for (const auto& list : {std::span<const Dem>(kKept), std::span<const Dem>(kProjected)})
    for (const Dem& dem : list) {
      const std::string bytes = test::bytes_of(dem_folder() / dem.name);
      constexpr std::size_t kCuts = 24;
      for (std::size_t i = 0; i < kCuts; ++i) {
        // Every 24th of the file, and ever closer to its begin and end.
        for (const std::size_t size : {bytes.size() * i / kCuts, std::size_t{1} << i,
                                       bytes.size() - (std::size_t{1} << i)}) {
          // A cut within the last number of a text cannot be seen.
          const bool text = std::filesystem::path(dem.name).extension() == ".asc";
          if (size >= bytes.size() || (text && size + 8 > bytes.size())) continue;
          const auto path = scratch.file(dem.name, bytes.substr(0, size));
          try {
            const ReadRasterResult read = read_raster(path, {.holes = HoleMode::keep});
            const Extremes found = extremes_of(read.grid);
            EXPECT_EQ(found.unknown, read.unknown_cells);
            EXPECT_LT(found.unknown, read.grid.heights.size());
            EXPECT_GE(found.lowest, dem.lowest - 10) << path << " " << size;
            EXPECT_LE(found.highest, dem.highest + 10) << path << " " << size;
          } catch (const Error& error) {
            const std::string_view line = error.what();
            EXPECT_EQ(error.kind(), ErrorKind::input) << line;
            EXPECT_TRUE(line.starts_with(path.string())) << line;
            EXPECT_EQ(line.find('\n'), std::string_view::npos) << line;
          }
        }
      }
    }
}

}  // namespace
}  // namespace talus
