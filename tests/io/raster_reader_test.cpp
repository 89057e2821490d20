#include "talus/io/raster_reader.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "io/rasters.h"
#include "io/scratch.h"
#include "talus/base/parallel.h"

namespace talus {
namespace {

using test::RasterFile;
using test::refusal_of;
using test::Scratch;
using test::write_raster;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

float at(const HeightGrid& grid, int x, int y) { return grid.heights[grid.index(x, y)]; }

ReadRasterResult read_as_is(const std::filesystem::path& path) {
  return read_raster(path, {.holes = HoleMode::keep});
}

TEST(ReadRaster, KeepsTheCellsOfAMetricRaster) {
  const Scratch scratch;
  const ReadRasterResult read = read_as_is(write_raster(scratch.path("a.tif"), {}));
  ASSERT_EQ(read.grid.nx, 4);
  ASSERT_EQ(read.grid.ny, 3);
  EXPECT_EQ(read.grid.cell, 10);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(at(read.grid, x, y), 100.0 * (2 - y) + x);
  EXPECT_EQ(read.georeference.crs, "EPSG:32632");
  EXPECT_EQ(read.georeference.offset, Vec2(500, 800));
  EXPECT_EQ(read.unknown_cells, 0u);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(ReadRaster, TurnsRowsThatRunNorth) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"),
                                 {.transform = std::array<double, 6>{500, 10, 0, 800, 0, 10}});
  const ReadRasterResult read = read_as_is(path);
  EXPECT_EQ(at(read.grid, 1, 0), 1);
  EXPECT_EQ(at(read.grid, 1, 2), 201);
  EXPECT_EQ(read.georeference.offset, Vec2(500, 800));
}

// An OpenEXR picture of some channels with the same numbers, as halves.
void write_exr(const std::filesystem::path& path, std::initializer_list<const char*> channels) {
  std::vector<half> pixels;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      pixels.emplace_back(100.0f * static_cast<float>(row) + static_cast<float>(column));
  Imf::Header header(4, 3);
  Imf::FrameBuffer buffer;
  for (const char* channel : channels) {
    header.channels().insert(channel, Imf::Channel(Imf::HALF));
    buffer.insert(channel, Imf::Slice::Make(Imf::HALF, pixels.data(), header.dataWindow()));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(3);
}

TEST(ReadRaster, ReadsTiffAsciiPngAndExr) {
  const Scratch scratch;
  write_raster(scratch.path("a.tif"), {});
  write_raster(scratch.path("a.asc"), {.driver = "AAIGrid"});
  write_raster(scratch.path("a.png"), {.type = GDT_UInt16, .driver = "PNG"});
  write_exr(scratch.path("a.exr"), {"Y"});
  for (const char* name : {"a.tif", "a.asc", "a.png", "a.exr"}) {
    const HeightGrid grid = read_raster(scratch.path(name)).grid;
    ASSERT_EQ(grid.nx, 4) << name;
    ASSERT_EQ(grid.ny, 3) << name;
    EXPECT_EQ(at(grid, 3, 0), 203) << name;
    EXPECT_EQ(at(grid, 0, 2), 0) << name;
  }
}

TEST(ReadRaster, ReadsAnyChannelOfAnExr) {
  const Scratch scratch;
  write_exr(scratch.path("depth.exr"), {"A", "B", "G", "R", "Z"});
  EXPECT_EQ(at(read_raster(scratch.path("depth.exr")).grid, 3, 0), 203);
  write_exr(scratch.path("color.exr"), {"A", "B", "G", "R"});
  const test::Refusal refusal = refusal_of([&] { read_raster(scratch.path("color.exr")); });
  EXPECT_EQ(refusal.kind, ErrorKind::input);
  EXPECT_NE(refusal.line.find("red, green, blue, alpha"), std::string::npos) << refusal.line;
  EXPECT_EQ(at(read_raster(scratch.path("color.exr"), {.band = 1}).grid, 3, 0), 203);

  const std::string bytes = test::bytes_of(scratch.path("depth.exr"));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto cut = scratch.file("cut.exr", bytes.substr(0, size));
    EXPECT_EQ(refusal_of([&] { read_raster(cut); }).kind, ErrorKind::input) << size;
  }
}

TEST(ReadRaster, HonorsScaleOffsetAndUnit) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {.dress = [](GDALDataset& dataset) {
                                   dataset.GetRasterBand(1)->SetScale(0.5);
                                   dataset.GetRasterBand(1)->SetOffset(7);
                                   dataset.GetRasterBand(1)->SetUnitType("ft");
                                 }});
  const HeightGrid grid = read_raster(path).grid;
  EXPECT_FLOAT_EQ(at(grid, 3, 0), static_cast<float>((203 * 0.5 + 7) * 0.3048));
  const HeightGrid scaled = read_raster(path, {.scale = 2, .offset = -5}).grid;
  EXPECT_FLOAT_EQ(at(scaled, 3, 0), 2 * at(grid, 3, 0) - 5);
}

TEST(ReadRaster, WarnsOfAUnitItDoesNotKnow) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {.dress = [](GDALDataset& dataset) {
                                   dataset.GetRasterBand(1)->SetUnitType("cubits");
                                 }});
  const ReadRasterResult read = read_raster(path);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].find("cubits"), std::string::npos);
}

TEST(ReadRaster, ConvertsTheUnitOfAVerticalSystem) {
  // NAD83(2011) / UTM zone 12N + NAVD88 height (ftUS).
  const Scratch scratch;
  const auto path =
      write_raster(scratch.path("a.tif"), {.epsg = 0, .dress = [](GDALDataset& dataset) {
                                             OGRSpatialReference crs;
                                             crs.SetFromUserInput("EPSG:6341+6360");
                                             dataset.SetSpatialRef(&crs);
                                           }});
  const ReadRasterResult read = read_raster(path);
  EXPECT_FLOAT_EQ(at(read.grid, 3, 0), static_cast<float>(203 * 1200.0 / 3937));
  EXPECT_EQ(read.georeference.crs, "EPSG:6341");
}

TEST(ReadRaster, TakesWhatIsNotFiniteOrMaskedForUnknown) {
  const Scratch scratch;
  const auto height = [](int column, int row) {
    if (row == 0)
      return column == 0 ? kNan : column == 1 ? HUGE_VAL : column == 2 ? -3.4e38 : -9999;
    return 5.0;
  };
  const auto path =
      write_raster(scratch.path("a.tif"), {.height = height, .dress = [](auto& dataset) {
                                             dataset.GetRasterBand(1)->SetNoDataValue(-9999);
                                           }});
  const ReadRasterResult read = read_as_is(path);
  EXPECT_EQ(read.unknown_cells, 4u);
  for (int x = 0; x < 4; ++x) {
    EXPECT_TRUE(std::isnan(at(read.grid, x, 2)));
    EXPECT_EQ(at(read.grid, x, 1), 5);
  }
  const ReadRasterResult filled = read_raster(path);
  EXPECT_EQ(filled.unknown_cells, 4u);
  for (const float z : filled.grid.heights) EXPECT_NEAR(z, 5, 1e-3);
}

TEST(ReadRaster, GivesARasterWithoutPlaceCellsOfAMetreOrAsAsked) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.png"),
                                 {.type = GDT_UInt16, .transform = {}, .epsg = 0, .driver = "PNG"});
  EXPECT_EQ(read_raster(path).grid.cell, 1);
  const ReadRasterResult read = read_raster(path, {.cell = 25});
  EXPECT_EQ(read.grid.cell, 25);
  EXPECT_EQ(read.grid.nx, 4);
  EXPECT_EQ(at(read.grid, 3, 0), 203);
  EXPECT_EQ(read.georeference.crs, "");
  EXPECT_EQ(read.georeference.offset, Vec2(0));
  // The crop is in metres from the corner then.
  const HeightGrid part = read_raster(path, {.crop = Box2{{25, 0}, {100, 50}}, .cell = 25}).grid;
  EXPECT_EQ(part.nx, 3);
  EXPECT_EQ(part.ny, 2);
  EXPECT_EQ(at(part, 0, 0), 201);
}

TEST(ReadRaster, ResamplesARasterWithoutPlaceFromItsPixelSize) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.png"),
                                 {.nx = 30,
                                  .ny = 20,
                                  .type = GDT_UInt16,
                                  .transform = {},
                                  .epsg = 0,
                                  .driver = "PNG",
                                  .height = [](int column, int row) { return 30 * column + row; }});
  EXPECT_EQ(read_raster(path, {.pixel_size = 8}).grid.cell, 8);
  const HeightGrid same = read_raster(path, {.cell = 8, .pixel_size = 8}).grid;
  EXPECT_EQ(same.nx, 30);
  EXPECT_EQ(at(same, 29, 0), 30 * 29 + 19);
  for (const double cell : {2.0, 24.0}) {
    const HeightGrid grid = read_raster(path, {.cell = cell, .pixel_size = 8}).grid;
    ASSERT_EQ(grid.nx, std::lround(30 * 8 / cell));
    ASSERT_EQ(grid.ny, std::lround(20 * 8 / cell));
    EXPECT_EQ(grid.cell, cell);
    const int x = grid.nx / 2, y = grid.ny / 2;
    EXPECT_NEAR(at(grid, x, y), 30 * ((x + 0.5) * cell / 8 - 0.5) + 20 - (y + 0.5) * cell / 8 - 0.5,
                1e-2);
  }
  const HeightGrid part =
      read_raster(path, {.crop = Box2{{80, 0}, {240, 160}}, .cell = 4, .pixel_size = 8}).grid;
  EXPECT_EQ(part.nx, 40);
  EXPECT_NEAR(at(part, 20, 20), 30 * (10 + 20.5 / 2 - 0.5) + 20 - 20.5 / 2 - 0.5, 1e-2);

  const auto placed = write_raster(scratch.path("b.tif"), {});
  EXPECT_THROW(read_raster(placed, {.pixel_size = 8}), Error);
}

TEST(ReadRaster, TakesAWorldFileInDegreesForWgs84AndWarns) {
  const Scratch scratch;
  const auto path = write_raster(
      scratch.path("a.png"),
      {.nx = 50, .ny = 60, .type = GDT_UInt16, .transform = {}, .epsg = 0, .driver = "PNG"});
  scratch.file("a.wld", "0.0008\n0\n0\n-0.0008\n10.0\n47.0\n");
  const ReadRasterResult read = read_raster(path);
  EXPECT_EQ(read.georeference.crs, "EPSG:32632");
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].find("WGS 84"), std::string::npos) << read.warnings[0];
  EXPECT_NEAR(read.grid.cell, 73.5, 0.5);

  // Larger cells are metres, with a warning too.
  scratch.file("a.wld", "5\n0\n0\n-5\n10.0\n47.0\n");
  const ReadRasterResult metric = read_raster(path);
  EXPECT_EQ(metric.georeference.crs, "");
  EXPECT_EQ(metric.grid.cell, 5);
  EXPECT_EQ(metric.warnings.size(), 1u);
}

TEST(ReadRaster, ResamplesToTheSpacingAsked) {
  // A plane stays one under every kernel, away from the border.
  const Scratch scratch;
  const auto plane = [](int column, int row) { return 3.0 * column - 2.0 * row; };
  const auto path = write_raster(scratch.path("a.tif"), {.nx = 30, .ny = 20, .height = plane});
  for (const Resampling resampling : {Resampling::bilinear, Resampling::cubic}) {
    const HeightGrid grid = read_raster(path, {.cell = 4, .resampling = resampling}).grid;
    ASSERT_EQ(grid.nx, 75);
    ASSERT_EQ(grid.ny, 50);
    EXPECT_EQ(grid.cell, 4);
    for (int y = 6; y < 44; ++y)
      for (int x = 6; x < 69; ++x) {
        const double column = (x + 0.5) * 0.4 - 0.5, row = 20 - (y + 0.5) * 0.4 - 0.5;
        EXPECT_NEAR(at(grid, x, y), 3 * column - 2 * row, 1e-3);
      }
  }
}

TEST(ReadRaster, MakesCellsSquareAndUpright) {
  const Scratch scratch;
  // Turned by 30 degrees, pixels of 20 m x 5 m; the height is the way east.
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const std::array<double, 6> transform = {1000, 20 * c, 5 * s, 2000, 20 * s, -5 * c};
  const auto east = [&](int column, int row) {
    return (column + 0.5) * transform[1] + (row + 0.5) * transform[2];
  };
  const auto path = write_raster(scratch.path("a.tif"),
                                 {.nx = 40, .ny = 160, .transform = transform, .height = east});
  const ReadRasterResult read = read_as_is(path);
  EXPECT_NEAR(read.grid.cell, 10, 1e-9);
  std::size_t known = 0;
  for (int y = 0; y < read.grid.ny; ++y)
    for (int x = 0; x < read.grid.nx; ++x) {
      const float z = at(read.grid, x, y);
      if (std::isnan(z)) continue;
      ++known;
      // At the border the kernel is cut off and leans inwards.
      EXPECT_NEAR(z, (x + 0.5) * 10 + read.georeference.offset.x - 1000, 25);
    }
  EXPECT_NEAR(static_cast<double>(known) * 100, 40 * 20 * 160 * 5, 2e4);
}

TEST(ReadRaster, ReprojectsDegreesMercatorAndFeet) {
  const Scratch scratch;
  struct Case {
    int epsg;
    std::array<double, 6> transform;
    const char* crs;
    double cell;
  };
  const Case cases[] = {{4326, {-70, 0.001, 0, -33, 0, -0.001}, "EPSG:32719", 101.75},
                        {4326, {20, 0.01, 0, 86, 0, -0.01}, "EPSG:5041", 300.9},
                        {4326, {20, 0.01, 0, -85, 0, -0.01}, "EPSG:5042", 321.7},
                        {3857, {1113194.9, 100, 0, 5621521.5, 0, -100}, "EPSG:32632", 70.6},
                        {3395, {1113194.9, 100, 0, 5591295.9, 0, -100}, "EPSG:32632", 70.7},
                        {2230, {6'300'000, 100, 0, 1'900'000, 0, -100}, "EPSG:32611", 30.48}};
  for (const Case& c : cases) {
    const auto path = write_raster(scratch.path("a.tif"),
                                   {.nx = 40, .ny = 40, .transform = c.transform, .epsg = c.epsg});
    const ReadRasterResult read = read_raster(path);
    EXPECT_EQ(read.georeference.crs, c.crs) << c.epsg;
    EXPECT_NEAR(read.grid.cell, c.cell, 0.01 * c.cell) << c.epsg;
  }
}

TEST(ReadRaster, CropsToWholeCells) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {.nx = 30, .ny = 20, .epsg = 32632});
  const ReadRasterResult whole = read_raster(path);
  const ReadRasterResult part = read_raster(path, {.crop = Box2{{542, 701}, {603, 780}}});
  EXPECT_EQ(part.grid.nx, 6);
  EXPECT_EQ(part.grid.ny, 8);
  EXPECT_EQ(part.georeference.offset, Vec2(540, 700));
  const int left = 4, below = static_cast<int>(700 - whole.georeference.offset.y) / 10;
  for (int y = 0; y < part.grid.ny; ++y)
    for (int x = 0; x < part.grid.nx; ++x)
      EXPECT_EQ(at(part.grid, x, y), at(whole.grid, x + left, y + below));
}

TEST(ReadRaster, RefusesACropBesideTheRaster) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {});
  for (const Box2& crop :
       {Box2{{0, 0}, {10, 10}}, Box2{{600, 810}, {510, 820}}, Box2{{kNan, 0}, {510, 820}}}) {
    const test::Refusal refusal = refusal_of([&] { read_raster(path, {.crop = crop}); });
    EXPECT_EQ(refusal.kind, ErrorKind::usage) << refusal.line;
    EXPECT_TRUE(refusal.line.starts_with("crop: ")) << refusal.line;
  }
}

TEST(ReadRaster, RefusesMoreThanTheMemoryLimitBeforeTakingIt) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {.nx = 100, .ny = 100});
  const test::Refusal refusal = refusal_of([&] { read_raster(path, {.cell = 0.001}); });
  EXPECT_EQ(refusal.kind, ErrorKind::job);
  EXPECT_NE(refusal.line.find("1000000 x 1000000 cells of 0.001 m"), std::string::npos)
      << refusal.line;
  EXPECT_NE(refusal.line.find("the memory limit is 4 GiB"), std::string::npos) << refusal.line;
  EXPECT_EQ(refusal_of([&] { read_raster(path, {.memory_limit = 30'000}); }).kind, ErrorKind::job);
}

TEST(ReadRaster, RefusesPicturesUnlessTheBandIsNamed) {
  const Scratch scratch;
  const auto color = [](GDALDataset& dataset) {
    for (int band = 1; band <= 3; ++band)
      dataset.GetRasterBand(band)->SetColorInterpretation(
          static_cast<GDALColorInterp>(GCI_RedBand + band - 1));
  };
  const auto picture =
      write_raster(scratch.path("a.tif"), {.bands = 3, .type = GDT_Byte, .dress = color});
  const test::Refusal refusal = refusal_of([&] { read_raster(picture); });
  EXPECT_EQ(refusal.kind, ErrorKind::input);
  EXPECT_NE(refusal.line.find("its bands are red, green, blue"), std::string::npos) << refusal.line;
  EXPECT_EQ(read_raster(picture, {.band = 2}).grid.nx, 4);
  EXPECT_EQ(refusal_of([&] { read_raster(picture, {.band = 4}); }).kind, ErrorKind::input);

  const auto palette =
      write_raster(scratch.path("b.tif"), {.type = GDT_Byte, .dress = [](auto& d) {
                                             GDALColorTable table;
                                             const GDALColorEntry entry{1, 2, 3, 255};
                                             table.SetColorEntry(0, &entry);
                                             d.GetRasterBand(1)->SetColorTable(&table);
                                           }});
  EXPECT_EQ(refusal_of([&] { read_raster(palette); }).kind, ErrorKind::input);
}

TEST(ReadRaster, RefusesWhatHoldsNoHeights) {
  const Scratch scratch;
  const auto nothing =
      write_raster(scratch.path("a.tif"), {.height = [](int, int) { return kNan; }});
  const auto complex = write_raster(scratch.path("b.tif"), {.type = GDT_CFloat32});
  for (const auto& path :
       {nothing, complex, scratch.file("c.tif", "no raster"), scratch.file("d.exr", "no raster"),
        scratch.file("e.asc", ""), scratch.path("missing.tif"), scratch.path("")}) {
    const test::Refusal refusal = refusal_of([&] { read_raster(path); });
    EXPECT_EQ(refusal.kind, ErrorKind::input) << refusal.line;
    EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << refusal.line;
    EXPECT_NE(refusal.line.find(path.string()), std::string::npos) << refusal.line;
  }
}

TEST(ReadRaster, OpensNothingBeyondLocalFiles) {
  const Scratch scratch;
  // A virtual raster leads anywhere, so it is none.
  const auto virtual_raster = scratch.file(
      "a.vrt",
      "<VRTDataset rasterXSize=\"4\" rasterYSize=\"4\"><VRTRasterBand dataType=\"Float32\" "
      "band=\"1\"><SimpleSource><SourceFilename>/vsicurl/http://127.0.0.1:9/a.tif"
      "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
  for (const std::filesystem::path& path :
       {virtual_raster, std::filesystem::path("/vsicurl/http://127.0.0.1:9/a.tif"),
        std::filesystem::path("MEM:::DATAPOINTER=0x1,PIXELS=1,LINES=1")})
    EXPECT_EQ(refusal_of([&] { read_raster(path); }).kind, ErrorKind::input);
}

TEST(ReadRaster, NeitherPrintsNorWrites) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {});
  const std::string bytes = test::bytes_of(path);
  const auto cut = scratch.file("cut.tif", bytes.substr(0, bytes.size() - 20));
  const std::size_t files = scratch.file_count();
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  read_raster(path);
  refusal_of([&] { read_raster(cut); });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(scratch.file_count(), files);
}

TEST(ReadRaster, StopsWhenTheJobIsCancelled) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"), {});
  Job job;
  job.cancel();
  EXPECT_THROW(read_raster(path, {.cell = 3}, &job), Cancelled);
}

TEST(ReadRaster, ReadsTheSameFromManyThreads) {
  const Scratch scratch;
  const auto path = write_raster(scratch.path("a.tif"),
                                 {.nx = 50,
                                  .ny = 50,
                                  .transform = std::array<double, 6>{10, 0.001, 0, 47, 0, -0.001},
                                  .epsg = 4326});
  const std::vector<float> expected = read_raster(path).grid.heights;
  std::vector<std::vector<float>> read(16);
  parallel_for(read.size(), [&](std::size_t i) { read[i] = read_raster(path).grid.heights; });
  for (const std::vector<float>& heights : read) EXPECT_EQ(heights, expected);
}

}  // namespace
}  // namespace talus
