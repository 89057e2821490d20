#include "talus/io/gdal_session.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace talus {
namespace {

// Drivers that lead to a network, to a database, to other files or to caches that they write.
constexpr auto kExcludedDrivers = std::to_array<std::string_view>(
    {"VRT", "DERIVED", "MEM", "WMS", "WCS", "WMTS", "HTTP", "OGCAPI", "STACTA", "STACIT", "EEDAI",
     "DAAS", "NGW", "PLMOSAIC", "PLSCENES", "PostGISRaster", "MRF", "PDF", "KMLSUPEROVERLAY"});

// Registers GDAL's drivers at the first call and tells which of them may open files.
const CPLStringList& allowed_drivers() {
  static const CPLStringList allowed = [] {
    GDALAllRegister();
    CPLStringList names;
    GDALDriverManager* manager = GetGDALDriverManager();
    for (int i = 0; i < manager->GetDriverCount(); ++i) {
      GDALDriver* driver = manager->GetDriver(i);
      const std::string_view name = driver->GetDescription();
      const bool excluded = std::find(kExcludedDrivers.begin(), kExcludedDrivers.end(), name) !=
                            kExcludedDrivers.end();
      if (driver->GetMetadataItem(GDAL_DCAP_RASTER) && !excluded)
        names.AddString(driver->GetDescription());
    }
    return names;
  }();
  return allowed;
}

}  // namespace

GdalSession::Option::Option(const char* key, const char* value) : key_(key) {
  if (const char* before = CPLGetThreadLocalConfigOption(key, nullptr)) before_ = before;
  CPLSetThreadLocalConfigOption(key, value);
}

GdalSession::Option::~Option() {
  CPLSetThreadLocalConfigOption(key_, before_ ? before_->c_str() : nullptr);
}

GdalSession::GdalSession() {
  CPLPushErrorHandlerEx(&hear, this);
  allowed_drivers();
}

GdalSession::~GdalSession() { CPLPopErrorHandler(); }

void CPL_STDCALL GdalSession::hear(CPLErr severity, CPLErrorNum, const char* message) {
  if (severity < CE_Failure) return;
  std::string line = message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  static_cast<GdalSession*>(CPLGetErrorHandlerUserData())->complaint_ = line;
}

GDALDatasetUniquePtr GdalSession::open(const std::filesystem::path& path) {
  // An absolute path begins with a slash: never a connection string.
  const std::string name = std::filesystem::absolute(path).string();
  complaint_.clear();
  return GDALDatasetUniquePtr(GDALDataset::Open(name.c_str(),
                                                GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR,
                                                allowed_drivers().List(), nullptr, nullptr));
}

}  // namespace talus
