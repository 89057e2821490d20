// Elevation rasters from other people's files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/field/height_grid.h"

namespace talus {

// What becomes of cells whose height is unknown.
enum class HoleMode {
  fill,  // a smooth surface from the heights around them
  keep,  // they stay unknown
};

// How heights between the raster's cells are found. Over several cells at once, where the grid is
// made coarser, bilinear and cubic are widened to match.
enum class Resampling { nearest, bilinear, cubic };

struct ReadRasterParams {
  std::optional<int> band;
  std::optional<Box2> crop;
  std::optional<double> cell;
  std::optional<double> pixel_size;
  Resampling resampling = Resampling::cubic;
  double scale = 1;
  double offset = 0;
  HoleMode holes = HoleMode::fill;
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  // bytes that reading may take; no key

  static void describe(auto& p, auto&& field) {
    field(p.crop, Field{.name = "crop",
                        .help = "the part to read, [x0, y0, x1, y1] in the raster's coordinate "
                                "system, in metres from its south-west corner if it has none; by "
                                "default all of it"});
    field(p.cell, Field{.name = "cell",
                        .help = "edge of a cell, which the raster is resampled to",
                        .unit = "m",
                        .min = 1e-3,
                        .max = 1e6});
    field(p.pixel_size,
          Field{.name = "pixel_size",
                .help = "edge of a pixel, for a raster that is not georeferenced; by default that "
                        "of a cell, or 1",
                .unit = "m",
                .min = 1e-3,
                .max = 1e6});
    field(p.resampling,
          Field{.name = "resampling", .help = "how heights between the raster's cells are found"});
    field(
        p.scale,
        Field{.name = "scale", .help = "what heights are multiplied by", .min = -1e6, .max = 1e6});
    field(p.offset, Field{.name = "offset",
                          .help = "what is added to heights after that",
                          .unit = "m",
                          .min = -1e6,
                          .max = 1e6});
    field(p.holes, Field{.name = "holes", .help = "what becomes of cells whose height is unknown"});
    field(p.band, Field{.name = "band",
                        .help = "the band that holds the heights; by default the first that is no "
                                "part of a picture",
                        .min = 1,
                        .max = 65'535});
  }
};

// Where a grid lies on Earth.
struct Georeference {
  std::string crs;  // "EPSG:32632", else WKT on one line; empty if it is not known
  Vec2 offset{0};   // what to add to local x and y for coordinates in `crs`
};

struct ReadRasterResult {
  HeightGrid grid;  // (0, 0) is the south-west corner of the extent
  Georeference georeference;
  std::size_t unknown_cells = 0;      // before holes were filled
  std::vector<std::string> warnings;  // one line each, naming the file
};

// The heights of a raster in any format GDAL reads, or OpenEXR, in metres, on a metric frame with
// north up and square cells. The raster's own scale, offset and unit of height are honored.
//
// Coordinates: a projected system in metres is kept. Geographic ones, those in another unit and
// Mercator's, which stretch the ground, are reprojected to the UTM zone of the center (beyond 84
// degrees north and 80 south to UPS). Without a system, cells below 0.1 with an origin within
// +-180, +-90 are taken for degrees (WGS 84), with a warning, other georeferences for metres.
//
// A raster that lies north up with square cells, in a system that is kept, comes out cell by cell
// as it is, unless `cell` asks for another spacing. All else is resampled by GDAL's warper without
// an error allowance; heights equal those of `gdalwarp -et 0` with the same kernel and extent. The
// extent is the bounding box of the raster or of `crop`, from its south-west corner on; by default
// there are as many cells to the area at its center as in the raster.
//
// A raster that is not georeferenced begins at (0, 0), and its pixels are squares of `pixel_size`.
//
// Heights that are not finite, or beyond 100 km, are unknown.
//
// Reads this file and those that belong to it; never writes, never asks a network. Safe to call
// from several threads. Throws `Error` (usage) for parameters out of range, a crop beside the
// raster and a pixel size for one that is georeferenced, (input) for a file that is missing,
// unreadable, malformed, a picture without heights or without one known height, (job) if it would
// take more than `memory_limit`, before memory is taken.
ReadRasterResult read_raster(const std::filesystem::path& path, const ReadRasterParams& params = {},
                             Job* job = nullptr);

}  // namespace talus
