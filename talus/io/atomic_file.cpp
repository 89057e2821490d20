#include "talus/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "talus/base/error.h"

namespace talus {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr int kNameAttempts = 1000;

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  // Renaming onto a folder fails late, onto a device would replace the device.
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path_, ignored);
  if (std::filesystem::is_directory(status)) fail(EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw job_error(fmt::format("{}: cannot write: not a regular file", path_.string()));

  // The first free name beside the final one; a killed run may have left some.
  for (int i = 0; descriptor_ < 0; ++i) {
    part_ = fmt::format("{}.{}.part", path_.string(), i);
    descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno != EEXIST || i == kNameAttempts)) fail(errno);
  }
  buffer_.reserve(kBufferBytes);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!part_.empty()) ::unlink(part_.c_str());
}

void AtomicFile::write(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  size_ += size;
  while (size > 0) {
    const std::size_t taken = std::min(size, kBufferBytes - buffer_.size());
    buffer_.insert(buffer_.end(), bytes, bytes + taken);
    if (buffer_.size() == kBufferBytes) flush();
    bytes += taken;
    size -= taken;
  }
}

void AtomicFile::commit() {
  flush();
  // Delayed allocation reports a full disk only here.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail(errno);
  if (::rename(part_.c_str(), path_.c_str()) != 0) fail(errno);
  part_.clear();
}

void AtomicFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t n = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (n < 0 && errno != EINTR) fail(errno);
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void AtomicFile::fail(int reason) const {
  throw job_error(
      fmt::format("{}: cannot write: {}", path_.string(), std::generic_category().message(reason)));
}

}  // namespace talus
