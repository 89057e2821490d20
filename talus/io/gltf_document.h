// A glTF 2.0 file in memory, every index and range checked on access.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/base/error.h"
#include "talus/base/vec.h"

namespace talus {

constexpr const char* kInstancingExtension = "EXT_mesh_gpu_instancing";

// Rows of numbers within a buffer of the document.
struct AccessorView {
  const char* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  int components = 1;
  int component_type = 0;  // 5120 i8, 5121 u8, 5122 i16, 5123 u16, 5125 u32, 5126 f32
  bool normalized = false;

  bool is_float() const { return component_type == 5126; }
  bool is_unsigned() const {
    return component_type == 5121 || component_type == 5123 || component_type == 5125;
  }
  // Normalized integers come out in [0, 1] or [-1, 1].
  double at(std::size_t row, int component) const;
  Vec3 vec3(std::size_t row) const { return {at(row, 0), at(row, 1), at(row, 2)}; }
};

// Every function throws `Error` (input) that names the file when the document is not as it should
// be.
class GltfDocument {
 public:
  // `bytes` must outlive the document: a GLB's buffer is used where it lies.
  GltfDocument(std::string_view bytes, const std::filesystem::path& path);

  const nlohmann::json& root() const { return root_; }

  // Number of entries of a top-level array such as "nodes"; 0 if there is none.
  std::size_t size(const char* array) const;
  const nlohmann::json& item(const char* array, std::size_t index) const;

  // Members of an object: absent is allowed, a wrong type is not.
  std::optional<std::size_t> index(const nlohmann::json& object, const char* key) const;
  std::vector<std::size_t> indices(const nlohmann::json& object, const char* key) const;
  std::vector<double> numbers(const nlohmann::json& object, const char* key,
                              std::size_t count) const;  // empty or `count` of them
  const nlohmann::json* member(const nlohmann::json& object, const char* key) const;

  // Lies within its buffer, for all rows.
  AccessorView accessor(std::size_t index) const;

  // A required extension must be known, unless it only concerns how surfaces look.
  void check_extensions() const;

  Error error(std::string_view what) const;

 private:
  std::string_view split_glb(std::string_view bytes);
  void load_buffers();
  std::string load_uri(const std::string& uri) const;

  std::filesystem::path path_;
  nlohmann::json root_;
  std::string_view glb_buffer_;
  std::vector<std::string> owned_buffers_;  // read from URIs
  std::vector<std::string_view> buffers_;
};

}  // namespace talus
