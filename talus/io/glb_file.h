// A GLB file as it is put together: the document at once, the bytes when it is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/vec.h"
#include "talus/io/atomic_file.h"

namespace talus {

// Numbers of the glTF specification.
constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
              kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr std::uint64_t kShortIndexVertices = 65'535;  // the last 16-bit index restarts primitives

// World to glTF.
inline Vec3f y_up(const Vec3f& p) { return {p.x, p.z, -p.y}; }
inline Vec3 y_up(const Vec3& p) { return {p.x, p.z, -p.y}; }

class GlbFile {
 public:
  // Appends to an array of the document, "meshes" or another; returns the index there.
  std::size_t add(const char* array, nlohmann::json entry);
  // Appends a node at the top of the scene.
  std::size_t add_part(nlohmann::json node);
  nlohmann::json& at(const char* array, std::size_t index) { return document_[array][index]; }
  std::size_t size(const char* array) const;
  // Without it the file cannot be read.
  void require_extension(const char* name);

  // Appends a view of `bytes` bytes, which `write` delivers later; 0 leaves a target or a stride
  // out.
  using Write = std::function<void(AtomicFile&)>;
  std::size_t add_view(std::uint64_t bytes, int target, int stride, Write write);
  std::size_t add_accessor(std::size_t view, std::uint64_t offset, int component_type,
                           const char* type, std::uint64_t count, bool normalized = false);

  // Returns the file's size. Throws `Error` (job) if it cannot be written or would pass 4 GiB.
  std::uint64_t write(const std::filesystem::path& path, Job* job);

 private:
  nlohmann::json document_ = {{"asset", {{"version", "2.0"}, {"generator", "Talus"}}},
                              {"scene", 0},
                              {"scenes", nlohmann::json::array({{{"name", "scene"}}})}};
  std::vector<Write> writes_;  // one for each view
  std::uint64_t bin_bytes_ = 0;
};

// Brings a file to a multiple of four bytes, at which views and chunks begin.
void pad(AtomicFile& file);

}  // namespace talus
