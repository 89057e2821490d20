#include "talus/scene/sealed_file.h"

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/io/atomic_file.h"
#include "talus/io/read_file.h"

namespace talus {
namespace {

constexpr std::size_t kDigestSize = 32;

std::string digest_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hex();
}

}  // namespace

void SealedWriter::save(const std::filesystem::path& path) const {
  AtomicFile file(path);
  file.write(bytes_);
  file.write(digest_of(bytes_));
  file.commit();
}

SealedReader::SealedReader(const std::filesystem::path& path, std::string_view magic)
    : name_(path.string()), file_(read_file(path)) {
  const std::string_view all = file_;
  const std::size_t size = all.size() < kDigestSize ? 0 : all.size() - kDigestSize;
  rest_ = all.substr(0, size);
  require(rest_.starts_with(magic) && all.substr(size) == digest_of(rest_));
  rest_.remove_prefix(magic.size());
}

void SealedReader::require(bool condition) const {
  if (!condition) throw input_error(name_ + ": damaged; delete it");
}

void SealedReader::copy(void* to, std::size_t size) {
  require(size <= rest_.size());
  if (size > 0) std::memcpy(to, rest_.data(), size);
  rest_.remove_prefix(size);
}

}  // namespace talus
