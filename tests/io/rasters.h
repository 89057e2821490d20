// Small rasters, written by GDAL itself.
#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>

namespace talus::test {

struct RasterFile {
  int nx = 4;
  int ny = 3;
  int bands = 1;
  GDALDataType type = GDT_Float32;
  std::optional<std::array<double, 6>> transform = std::array<double, 6>{500, 10, 0, 830, 0, -10};
  int epsg = 32632;  // 0: none
  const char* driver = "GTiff";
  std::function<double(int column, int row)> height = [](int column, int row) {
    return 100.0 * row + column;
  };
  std::function<void(GDALDataset&)> dress = [](GDALDataset&) {};
};

// Formats that can only be copied into take the way through memory.
inline std::filesystem::path write_raster(const std::filesystem::path& path,
                                          const RasterFile& file) {
  GDALAllRegister();
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const GDALDatasetUniquePtr dataset(
      memory->Create("", file.nx, file.ny, file.bands, file.type, nullptr));
  if (file.transform) {
    std::array<double, 6> transform = *file.transform;
    dataset->SetGeoTransform(transform.data());
  }
  if (file.epsg != 0) {
    OGRSpatialReference crs;
    crs.importFromEPSG(file.epsg);
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  for (int band = 1; band <= file.bands; ++band)
    for (int row = 0; row < file.ny; ++row)
      for (int column = 0; column < file.nx; ++column) {
        double height = file.height(column, row);
        EXPECT_EQ(dataset->GetRasterBand(band)->RasterIO(GF_Write, column, row, 1, 1, &height, 1, 1,
                                                         GDT_Float64, 0, 0, nullptr),
                  CE_None);
      }
  file.dress(*dataset);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(file.driver);
  const GDALDatasetUniquePtr written(
      driver->CreateCopy(path.c_str(), dataset.get(), false, nullptr, nullptr, nullptr));
  EXPECT_TRUE(written) << path;
  return path;
}

}  // namespace talus::test
