#include "talus/io/raster_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "talus/base/error.h"
#include "talus/io/open_exr.h"
#include "talus/io/read_file.h"

namespace talus {
namespace {

constexpr double kHeightMax = 100'000;  // metres; beyond lie fill values that nobody declared
constexpr int kStripPixels = 1 << 20;   // read at once

struct LengthUnit {
  std::string_view name;
  double metres;
};
constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937.0;
constexpr LengthUnit kUnits[] = {{"", 1},
                                 {"m", 1},
                                 {"metre", 1},
                                 {"metres", 1},
                                 {"meter", 1},
                                 {"meters", 1},
                                 {"dm", 0.1},
                                 {"cm", 0.01},
                                 {"mm", 0.001},
                                 {"km", 1000},
                                 {"ft", kFoot},
                                 {"foot", kFoot},
                                 {"feet", kFoot},
                                 {"us-ft", kSurveyFoot},
                                 {"us_ft", kSurveyFoot},
                                 {"ftus", kSurveyFoot},
                                 {"us survey foot", kSurveyFoot},
                                 {"us survey feet", kSurveyFoot},
                                 {"foot_us", kSurveyFoot}};

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

// Part of a picture: a color or what goes with colors.
bool is_picture(GDALRasterBand& band) {
  const GDALColorInterp meaning = band.GetColorInterpretation();
  return meaning != GCI_Undefined && meaning != GCI_GrayIndex;
}

// The first dozen of what a picture's bands are.
std::string band_meanings(GDALDataset& dataset) {
  std::string list;
  for (int i = 1; i <= std::min(dataset.GetRasterCount(), 12); ++i)
    list += fmt::format(
        "{}{}", i > 1 ? ", " : "",
        lower(GDALGetColorInterpretationName(dataset.GetRasterBand(i)->GetColorInterpretation())));
  return list;
}

bool is_degrees(const PixelTransform& a) {
  return std::hypot(a[1], a[4]) < 0.1 && std::hypot(a[2], a[5]) < 0.1 && std::abs(a[0]) <= 180 &&
         std::abs(a[3]) <= 90;
}

int CPL_STDCALL keep_reading(double, const char*, void* job) {
  return !static_cast<Job*>(job)->cancelled();
}

}  // namespace

Vec2 apply(const PixelTransform& a, const Vec2& pixel) {
  return {a[0] + pixel.x * a[1] + pixel.y * a[2], a[3] + pixel.x * a[4] + pixel.y * a[5]};
}

double mean_cell(const PixelTransform& a) { return std::sqrt(std::abs(a[1] * a[5] - a[2] * a[4])); }

RasterSource::RasterSource(const std::filesystem::path& path, const ReadRasterParams& params,
                           GdalSession& session)
    : path_(path), session_(session) {
  check_readable_file(path);
  dataset_ = is_exr(path) ? open_exr(path, params.memory_limit) : session.open(path);
  if (!dataset_) throw error("no raster that can be read");
  find_band(params.band);
  find_place();
  find_unit();
}

Error RasterSource::error(std::string_view what) const {
  if (session_.complaint().empty()) return input_error(fmt::format("{}: {}", path_.string(), what));
  return input_error(fmt::format("{}: {}: {}", path_.string(), what, session_.complaint()));
}

void RasterSource::warn(std::string_view what) {
  warnings_.push_back(fmt::format("{}: {}", path_.string(), what));
}

void RasterSource::find_band(std::optional<int> number) {
  const int count = dataset_->GetRasterCount();
  if (count == 0) throw error("holds no raster band");
  if (number) {
    if (*number > count)
      throw error(fmt::format("has no band {}; its bands are 1 to {}", *number, count));
    band_ = dataset_->GetRasterBand(*number);
  } else {
    for (int i = count; i >= 1; --i)
      if (!is_picture(*dataset_->GetRasterBand(i))) band_ = dataset_->GetRasterBand(i);
    if (!band_)
      throw error(
          fmt::format("a picture without heights, its bands are {}; name the band if one of "
                      "them holds heights (band = 1)",
                      band_meanings(*dataset_)));
  }
  const GDALDataType type = band_->GetRasterDataType();
  if (GDALDataTypeIsComplex(type)) throw error("its numbers are complex, no heights");
  if (type == GDT_Byte) warn("heights have 8 bits only and come in 256 levels");
}

void RasterSource::find_place() {
  PixelTransform a{};
  if (dataset_->GetGeoTransform(a.data()) != CE_None) return;
  transform_ = a;
  if (!std::all_of(a.begin(), a.end(), [](double x) { return std::isfinite(x); }) ||
      !(mean_cell(a) > 0))
    throw error("its georeference has no area; mend it, or remove it to give the size of a cell");

  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  if (crs && (crs->IsGeographic() || crs->IsProjected())) {
    crs_ = *crs;
    crs_.StripVertical();
    crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  } else if (crs) {
    warn("its coordinate system is neither geographic nor projected; taken for metres");
  } else if (is_degrees(a)) {
    warn("no coordinate system, but coordinates that look like degrees; taken for WGS 84");
    crs_.SetWellKnownGeogCS("WGS84");
    crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  } else {
    warn("no coordinate system; its coordinates are taken for metres");
  }
}

void RasterSource::find_unit() {
  // A vertical system counts where the band itself says nothing.
  double metres = 1;
  const std::string name = lower(band_->GetUnitType());
  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  const auto* unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                  [&](const LengthUnit& u) { return u.name == name; });
  if (unit == std::end(kUnits))
    warn(fmt::format("heights in the unknown unit \"{}\" are taken for metres", name));
  else if (name.empty() && crs && crs->IsVertical())
    metres = crs->GetTargetLinearUnits("VERT_CS", nullptr);
  else
    metres = unit->metres;
  scale_ = band_->GetScale() * metres;
  offset_ = band_->GetOffset() * metres;
}

std::vector<float> RasterSource::read(const PixelWindow& window, Job* job) const {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const auto width = static_cast<std::size_t>(window.nx);
  const bool masked = (band_->GetMaskFlags() & GMF_ALL_VALID) == 0;
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  if (job) {
    extra.pfnProgress = keep_reading;
    extra.pProgressData = job;
  }

  std::vector<float> heights(width * static_cast<std::size_t>(window.ny));
  const int strip = std::max(1, kStripPixels / window.nx);
  std::vector<double> values;
  std::vector<std::uint8_t> mask;
  for (int row = 0; row < window.ny; row += strip) {
    report_progress(job, "read raster", static_cast<double>(row) / window.ny);
    const int rows = std::min(strip, window.ny - row);
    values.resize(width * static_cast<std::size_t>(rows));
    mask.assign(values.size(), 255);
    const auto read_strip = [&](GDALRasterBand& band, void* out, GDALDataType type) {
      if (band.RasterIO(GF_Read, window.x, window.y + row, window.nx, rows, out, window.nx, rows,
                        type, 0, 0, &extra) == CE_None)
        return;
      check_cancelled(job);
      throw error("cannot be read whole");
    };
    read_strip(*band_, values.data(), GDT_Float64);
    if (masked) read_strip(*band_->GetMaskBand(), mask.data(), GDT_Byte);

    float* out = heights.data() + static_cast<std::size_t>(row) * width;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double height = values[i] * scale_ + offset_;
      const bool known = mask[i] != 0 && std::abs(height) <= kHeightMax;
      out[i] = known ? static_cast<float>(height) : kUnknown;
    }
  }
  return heights;
}

}  // namespace talus
