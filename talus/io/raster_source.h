// One band of heights of an open raster.
#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "talus/io/gdal_session.h"
#include "talus/io/raster_reader.h"

namespace talus {

// From (column, row), counted from the corner of the first pixel, to coordinates:
// x = a[0] + column a[1] + row a[2], y = a[3] + column a[4] + row a[5].
using PixelTransform = std::array<double, 6>;

Vec2 apply(const PixelTransform& a, const Vec2& pixel);
// The edge of a square with a pixel's area.
double mean_cell(const PixelTransform& a);

// Pixels [x, x + nx) x [y, y + ny).
struct PixelWindow {
  int x = 0;
  int y = 0;
  int nx = 0;
  int ny = 0;
};

class RasterSource {
 public:
  // Opens the file and finds the band. Throws `Error`, see `read_raster`.
  RasterSource(const std::filesystem::path& path, const ReadRasterParams& params,
               GdalSession& session);

  int nx() const { return dataset_->GetRasterXSize(); }
  int ny() const { return dataset_->GetRasterYSize(); }

  // Absent if nothing tells where the raster lies.
  const std::optional<PixelTransform>& transform() const { return transform_; }
  // Empty if it is not known: coordinates are metres then.
  const OGRSpatialReference& crs() const { return crs_; }

  // Heights of a window in metres, rows as in the file; NaN where they are unknown. Throws `Error`
  // (input) for what cannot be read.
  std::vector<float> read(const PixelWindow& window, Job* job) const;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void find_band(std::optional<int> number);
  void find_place();
  void find_unit();
  Error error(std::string_view what) const;
  void warn(std::string_view what);

  std::filesystem::path path_;
  GdalSession& session_;
  GDALDatasetUniquePtr dataset_;
  GDALRasterBand* band_ = nullptr;
  std::optional<PixelTransform> transform_;
  OGRSpatialReference crs_;
  double scale_ = 1;   // metres per unit of what is stored
  double offset_ = 0;  // metres
  std::vector<std::string> warnings_;
};

}  // namespace talus
