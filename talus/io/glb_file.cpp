#include "talus/io/glb_file.h"

#include <fmt/format.h>

#include <limits>
#include <string>
#include <utility>

#include "talus/base/error.h"

namespace talus {

using nlohmann::json;

std::size_t GlbFile::add(const char* array, json entry) {
  json& entries = document_[array];
  entries.push_back(std::move(entry));
  return entries.size() - 1;
}

std::size_t GlbFile::add_part(json node) {
  const std::size_t index = add("nodes", std::move(node));
  document_["scenes"][0]["nodes"].push_back(index);
  return index;
}

std::size_t GlbFile::size(const char* array) const {
  return document_.contains(array) ? document_[array].size() : 0;
}

void GlbFile::require_extension(const char* name) {
  add("extensionsUsed", name);
  add("extensionsRequired", name);
}

std::size_t GlbFile::add_view(std::uint64_t bytes, int target, int stride, Write write) {
  json view = {{"buffer", 0}, {"byteOffset", bin_bytes_}, {"byteLength", bytes}};
  if (target != 0) view["target"] = target;
  if (stride != 0) view["byteStride"] = stride;
  bin_bytes_ += (bytes + 3) / 4 * 4;
  writes_.push_back(std::move(write));
  return add("bufferViews", std::move(view));
}

std::size_t GlbFile::add_accessor(std::size_t view, std::uint64_t offset, int component_type,
                                  const char* type, std::uint64_t count, bool normalized) {
  json accessor = {{"bufferView", view},
                   {"byteOffset", offset},
                   {"componentType", component_type},
                   {"type", type},
                   {"count", count}};
  if (normalized) accessor["normalized"] = true;
  return add("accessors", std::move(accessor));
}

std::uint64_t GlbFile::write(const std::filesystem::path& path, Job* job) {
  if (bin_bytes_ > 0) document_["buffers"] = json::array({{{"byteLength", bin_bytes_}}});
  std::string text = document_.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + text.size() + (bin_bytes_ > 0 ? 8 + bin_bytes_ : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw job_error(
        fmt::format("{}: the scene takes {:.1f} GiB, a GLB holds at most 4; write "
                    "instances, or fewer stones",
                    path.string(), static_cast<double>(total) / (1ull << 30)));
  AtomicFile file(path);
  file.write("glTF");
  file.write_value(std::uint32_t{2});
  file.write_value(static_cast<std::uint32_t>(total));
  file.write_value(static_cast<std::uint32_t>(text.size()));
  file.write("JSON");
  file.write(text);
  if (bin_bytes_ > 0) {
    file.write_value(static_cast<std::uint32_t>(bin_bytes_));
    file.write(std::string_view("BIN\0", 4));
  }
  for (const Write& write_view : writes_) {
    report_progress(job, "write GLB",
                    static_cast<double>(file.size()) / static_cast<double>(total));
    write_view(file);
    pad(file);
  }
  TALUS_ASSERT(file.size() == total);
  file.commit();
  return total;
}

void pad(AtomicFile& file) {
  while (file.size() % 4 != 0) file.write_value('\0');
}

}  // namespace talus
