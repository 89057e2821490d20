#include "talus/io/raster_reader.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "talus/io/fill_holes.h"
#include "talus/io/gdal_session.h"
#include "talus/io/raster_frame.h"
#include "talus/io/raster_source.h"

namespace talus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

void check_params(const ReadRasterParams& params) {
  validate(params);
  if (!params.crop) return;
  const Vec2 size = params.crop->size();
  if (!(size.x > 0 && size.y > 0) || !std::isfinite(size.x + size.y))
    throw usage_error(
        "crop: [x0, y0, x1, y1] must be finite, with x0 less than x1 and y0 less than y1");
}

// "EPSG:32632" where there is such a number, else WKT.
std::string name_of(const OGRSpatialReference& crs) {
  if (crs.IsEmpty()) return {};
  const char *authority = crs.GetAuthorityName(nullptr), *code = crs.GetAuthorityCode(nullptr);
  if (authority && code) return fmt::format("{}:{}", authority, code);
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string wkt = text;
  CPLFree(text);
  return wkt;
}

// Where a window of a raster lies.
PixelTransform moved(PixelTransform a, const PixelWindow& window) {
  const Vec2 corner = apply(a, {window.x, window.y});
  a[0] = corner.x;
  a[3] = corner.y;
  return a;
}

// Heights in memory as GDAL sees them; the heights must outlive it.
GDALDatasetUniquePtr dataset_over(std::vector<float>& heights, int nx, int ny,
                                  PixelTransform transform, const OGRSpatialReference& crs) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr dataset(driver->Create("", nx, ny, 0, GDT_Float32, nullptr));
  CPLStringList options;
  options.SetNameValue(
      "DATAPOINTER",
      fmt::format("{:#x}", reinterpret_cast<std::uintptr_t>(heights.data())).c_str());
  dataset->AddBand(GDT_Float32, options.List());
  dataset->GetRasterBand(1)->SetNoDataValue(kUnknown);
  dataset->SetGeoTransform(transform.data());
  if (!crs.IsEmpty()) dataset->SetSpatialRef(&crs);
  return dataset;
}

int CPL_STDCALL tell_progress(double fraction, const char*, void* job) {
  if (static_cast<Job*>(job)->cancelled()) return 0;
  static_cast<Job*>(job)->progress("resample raster", fraction);
  return 1;
}

// The pixels of the frame's window onto its cells, rows from the north; empty if GDAL fails.
std::vector<float> resample(std::vector<float>& pixels, const OGRSpatialReference& crs,
                            const RasterFrame& frame, Resampling resampling, Job* job) {
  std::vector<float> heights(static_cast<std::size_t>(frame.nx) *
                             static_cast<std::size_t>(frame.ny));
  const GDALDatasetUniquePtr from = dataset_over(pixels, frame.window.nx, frame.window.ny,
                                                 moved(frame.source, frame.window), crs);
  const GDALDatasetUniquePtr to =
      dataset_over(heights, frame.nx, frame.ny, target_transform(frame), frame.crs);
  constexpr const char* kKernels[] = {"near", "bilinear", "cubic"};
  CPLStringList arguments;
  for (const char* argument : {"-r", kKernels[static_cast<std::size_t>(resampling)], "-et", "0",
                               "-wm", "64", "-wo", "INIT_DEST=NO_DATA"})
    arguments.AddString(argument);
  const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> options(
      GDALWarpAppOptionsNew(arguments.List(), nullptr), GDALWarpAppOptionsFree);
  if (job) GDALWarpAppOptionsSetProgress(options.get(), tell_progress, job);
  GDALDatasetH source = from.get();
  const bool done = GDALWarp(nullptr, to.get(), 1, &source, options.get(), nullptr) != nullptr;
  check_cancelled(job);
  return done ? heights : std::vector<float>();
}

void reverse_rows(std::vector<float>& heights, int nx) {
  const auto row = static_cast<std::ptrdiff_t>(nx);
  for (auto a = heights.begin(), b = heights.end() - row; a < b; a += row, b -= row)
    std::swap_ranges(a, a + row, b);
}

}  // namespace

ReadRasterResult read_raster(const std::filesystem::path& path, const ReadRasterParams& params,
                             Job* job) {
  check_params(params);
  GdalSession session;
  const RasterSource source(path, params, session);
  const RasterFrame frame = choose_frame(path, source, params);

  ReadRasterResult result{.grid = {.nx = frame.nx, .ny = frame.ny, .cell = frame.cell},
                          .georeference = {.crs = name_of(frame.crs), .offset = frame.corner},
                          .warnings = source.warnings()};
  std::vector<float>& heights = result.grid.heights;
  heights = source.read(frame.window, job);
  if (frame.resampled) heights = resample(heights, source.crs(), frame, params.resampling, job);
  if (heights.empty())
    throw input_error(
        fmt::format("{}: cannot be resampled: {}", path.string(), session.complaint()));
  if (frame.resampled || frame.source[5] < 0) reverse_rows(heights, frame.nx);

  // The user's own scale goes last; it leaves unknown heights unknown.
  for (float& height : heights) {
    if (std::isnan(height)) ++result.unknown_cells;
    height = static_cast<float>(height * params.scale + params.offset);
  }
  if (result.unknown_cells == heights.size())
    throw input_error(fmt::format("{}: no height is known{}", path.string(),
                                  params.crop ? " in the part to read" : ""));
  if (params.holes == HoleMode::fill && result.unknown_cells > 0) fill_holes(result.grid, job);
  return result;
}

}  // namespace talus
