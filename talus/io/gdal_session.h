// GDAL behind a wall: silent, local, read-only.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>

namespace talus {

// While alive, what this thread asks of GDAL neither prints, nor writes beside the file, nor uses a
// network. Sessions of one thread nest.
class GdalSession {
 public:
  GdalSession();
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  // Null if no format that lives in local files knows it; `complaint` then tells why.
  GDALDatasetUniquePtr open(const std::filesystem::path& path);

  // What GDAL reported last, on one line; empty if nothing.
  const std::string& complaint() const { return complaint_; }

 private:
  // A configuration option of this thread, set back at the end.
  class Option {
   public:
    Option(const char* key, const char* value);
    ~Option();

   private:
    const char* key_;
    std::optional<std::string> before_;
  };

  static void CPL_STDCALL hear(CPLErr severity, CPLErrorNum number, const char* message);

  Option no_sidecars_{"GDAL_PAM_ENABLED", "NO"};
  Option no_network_{"CPL_VSIL_CURL_ALLOWED_FILENAME", "none"};
  Option no_half_pictures_{"GDAL_ERROR_ON_LIBJPEG_WARNING", "YES"};
  std::string complaint_;
};

}  // namespace talus
