#include "talus/io/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "talus/io/read_file.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr std::uint32_t kGlbMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinChunk = 0x004e4942;

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class T>
double load(const char* data, bool normalized) {
  T value;
  std::memcpy(&value, data, sizeof value);
  if (!normalized) return static_cast<double>(value);
  return std::max(-1.0,
                  static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()));
}

std::size_t component_bytes(std::size_t type) {
  return type == 5120 || type == 5121   ? 1
         : type == 5122 || type == 5123 ? 2
         : type == 5125 || type == 5126 ? 4
                                        : 0;
}

int components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

int hex_digit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

std::string percent_decoded(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                         hex_digit(uri[i + 2]) >= 0;
    out += escaped ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
    if (escaped) i += 2;
  }
  return out;
}

std::string base64_decoded(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) break;  // padding ends the data
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      out += static_cast<char>(bits >> bit_count & 0xff);
    }
  }
  return out;
}

}  // namespace

double AccessorView::at(std::size_t row, int component) const {
  const char* p = data + row * stride +
                  static_cast<std::size_t>(component) *
                      component_bytes(static_cast<std::size_t>(component_type));
  switch (component_type) {
    case 5120:
      return load<std::int8_t>(p, normalized);
    case 5121:
      return load<std::uint8_t>(p, normalized);
    case 5122:
      return load<std::int16_t>(p, normalized);
    case 5123:
      return load<std::uint16_t>(p, normalized);
    case 5125:
      return load<std::uint32_t>(p, normalized);
    default:
      return load<float>(p, false);
  }
}

GltfDocument::GltfDocument(std::string_view bytes, const std::filesystem::path& path)
    : path_(path) {
  const bool binary = bytes.size() >= 4 && u32_at(bytes, 0) == kGlbMagic;
  const std::string_view text = binary ? split_glb(bytes) : bytes;
  root_ = json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (!root_.is_object()) throw error("no glTF: its JSON is malformed or cut off");

  const json* asset = member(root_, "asset");
  const json* version = asset ? member(*asset, "version") : nullptr;
  if (!version || !version->is_string() || !version->get<std::string>().starts_with("2."))
    throw error("no glTF 2.0: asset.version should be \"2.0\"");
  load_buffers();
}

std::string_view GltfDocument::split_glb(std::string_view bytes) {
  if (bytes.size() < 20) throw error("no GLB: cut off within its header");
  const std::uint64_t length = u32_at(bytes, 8);
  if (u32_at(bytes, 4) != 2) throw error("GLB version should be 2");
  if (length > bytes.size())
    throw error(fmt::format("cut off: it should have {} bytes, but has {}", length, bytes.size()));

  const std::uint64_t json_bytes = u32_at(bytes, 12);
  if (u32_at(bytes, 16) != kJsonChunk || 20 + json_bytes > length)
    throw error("no GLB: the first chunk should be JSON within the file");
  const std::uint64_t bin_header = 20 + json_bytes;
  if (bin_header + 8 <= length && u32_at(bytes, bin_header + 4) == kBinChunk) {
    const std::uint64_t bin_bytes = u32_at(bytes, bin_header);
    if (bin_header + 8 + bin_bytes > length)
      throw error("the binary chunk reaches past the end of the file");
    glb_buffer_ = bytes.substr(bin_header + 8, bin_bytes);
  }
  return bytes.substr(20, json_bytes);
}

void GltfDocument::load_buffers() {
  const std::size_t count = size("buffers");
  owned_buffers_.reserve(count);  // views into them must not move
  for (std::size_t i = 0; i < count; ++i) {
    const json& buffer = item("buffers", i);
    const json* uri = member(buffer, "uri");
    if (uri && !uri->is_string()) throw error(fmt::format("buffer {}: uri should be a text", i));
    if (uri) {
      owned_buffers_.push_back(load_uri(uri->get<std::string>()));
      buffers_.push_back(owned_buffers_.back());
    } else {
      buffers_.push_back(i == 0 ? glb_buffer_ : std::string_view());
    }
    const std::size_t claimed = index(buffer, "byteLength").value_or(0);
    if (claimed > buffers_[i].size())
      throw error(fmt::format("buffer {} should have {} bytes, but has {}", i, claimed,
                              buffers_[i].size()));
  }
}

std::string GltfDocument::load_uri(const std::string& uri) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) throw error("a data URI of a buffer should be base64");
    return base64_decoded(std::string_view(uri).substr(comma + 8));
  }
  try {
    return read_file(path_.parent_path() / percent_decoded(uri));
  } catch (const Error& missing) {
    throw error(fmt::format("needs a buffer beside it: {}", missing.what()));
  }
}

std::size_t GltfDocument::size(const char* array) const {
  const json* found = member(root_, array);
  if (found && !found->is_array()) throw error(fmt::format("{} should be a list", array));
  return found ? found->size() : 0;
}

const json& GltfDocument::item(const char* array, std::size_t index) const {
  const std::size_t count = size(array);
  if (index >= count)
    throw error(fmt::format("refers to entry {} of {}, which has {}", index, array, count));
  const json& found = root_[array][index];
  if (!found.is_object()) throw error(fmt::format("{}[{}] should be an object", array, index));
  return found;
}

const json* GltfDocument::member(const json& object, const char* key) const {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::size_t> GltfDocument::index(const json& object, const char* key) const {
  const json* found = member(object, key);
  if (!found) return std::nullopt;
  if (!found->is_number_unsigned())
    throw error(fmt::format("{} should be a whole number from 0 on", key));
  return found->get<std::size_t>();
}

std::vector<std::size_t> GltfDocument::indices(const json& object, const char* key) const {
  const json* found = member(object, key);
  std::vector<std::size_t> out;
  if (!found) return out;
  if (!found->is_array()) throw error(fmt::format("{} should be a list", key));
  for (const json& entry : *found) {
    if (!entry.is_number_unsigned())
      throw error(fmt::format("{} should list whole numbers from 0 on", key));
    out.push_back(entry.get<std::size_t>());
  }
  return out;
}

std::vector<double> GltfDocument::numbers(const json& object, const char* key,
                                          std::size_t count) const {
  const json* found = member(object, key);
  std::vector<double> out;
  if (!found) return out;
  const auto is_number = [](const json& entry) { return entry.is_number(); };
  if (!found->is_array() || found->size() != count ||
      !std::all_of(found->begin(), found->end(), is_number))
    throw error(fmt::format("{} should be {} numbers", key, count));
  return found->get<std::vector<double>>();
}

AccessorView GltfDocument::accessor(std::size_t which) const {
  const json& accessor = item("accessors", which);
  if (member(accessor, "sparse"))
    throw error(fmt::format("accessor {} is sparse, which is not read; save it dense", which));
  const std::optional<std::size_t> view_index = index(accessor, "bufferView");
  if (!view_index) throw error(fmt::format("accessor {} has no bufferView", which));
  const json& view = item("bufferViews", *view_index);

  AccessorView out;
  const std::size_t type = index(accessor, "componentType").value_or(0);
  const std::size_t bytes = component_bytes(type);
  const json* shape = member(accessor, "type");
  out.components = shape && shape->is_string() ? components_of(shape->get<std::string>()) : 0;
  if (bytes == 0 || out.components == 0)
    throw error(fmt::format("accessor {} has an unknown type", which));
  const json* normalized = member(accessor, "normalized");
  out.component_type = static_cast<int>(type);
  out.normalized = normalized && normalized->is_boolean() && normalized->get<bool>();
  out.count = index(accessor, "count").value_or(0);

  // Row, view and buffer are compared by subtraction: sums of claimed numbers may overflow.
  const std::size_t row = bytes * static_cast<std::size_t>(out.components);
  const std::size_t buffer_index = index(view, "buffer").value_or(0);
  if (buffer_index >= buffers_.size())
    throw error(fmt::format("bufferView {} refers to a buffer that is not there", *view_index));
  const std::string_view buffer = buffers_[buffer_index];
  const std::size_t view_begin = index(view, "byteOffset").value_or(0);
  const std::size_t view_bytes = index(view, "byteLength").value_or(0);
  if (view_begin > buffer.size() || view_bytes > buffer.size() - view_begin)
    throw error(fmt::format("bufferView {} reaches past its buffer", *view_index));
  const std::size_t begin = index(accessor, "byteOffset").value_or(0);
  out.stride = index(view, "byteStride").value_or(row);
  if (out.stride < row || out.stride > 252)
    throw error(fmt::format("bufferView {} has a byteStride of {}", *view_index, out.stride));
  if (begin > view_bytes ||
      (out.count > 0 &&
       (row > view_bytes - begin || out.count - 1 > (view_bytes - begin - row) / out.stride)))
    throw error(fmt::format("accessor {} reaches past its bufferView", which));
  out.data = buffer.data() + view_begin + begin;
  return out;
}

void GltfDocument::check_extensions() const {
  const json* required = member(root(), "extensionsRequired");
  if (!required) return;
  if (!required->is_array()) throw error("extensionsRequired should be a list");
  for (const json& entry : *required) {
    const std::string name = entry.is_string() ? entry.get<std::string>() : "?";
    const bool harmless = name == kInstancingExtension || name == "KHR_mesh_quantization" ||
                          name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
                          name.starts_with("KHR_lights_") || name.starts_with("EXT_texture_");
    if (!harmless)
      throw error(
          fmt::format("requires the extension {}, which is not read; save it without", name));
  }
}

Error GltfDocument::error(std::string_view what) const {
  return input_error(fmt::format("{}: {}", path_.string(), what));
}

}  // namespace talus
