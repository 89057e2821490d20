// Where a raster's heights go: a metric frame with north up and square cells.
#pragma once

#include "talus/io/raster_source.h"

namespace talus {

struct RasterFrame {
  int nx = 1;
  int ny = 1;
  double cell = 1;  // metres
  Vec2 corner{0};   // south-west, in `crs`
  OGRSpatialReference crs;

  PixelTransform source{};  // of the whole raster; made up if it has none
  PixelWindow window;       // the pixels that are needed
  bool resampled = false;   // else the pixels of the window are the cells
};

// Decides on everything before heights are read. Throws `Error`, see `read_raster`.
RasterFrame choose_frame(const std::filesystem::path& path, const RasterSource& source,
                         const ReadRasterParams& params);

// North up: from column and row of the frame's cells.
PixelTransform target_transform(const RasterFrame& frame);

}  // namespace talus
