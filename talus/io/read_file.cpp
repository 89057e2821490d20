#include "talus/io/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "talus/base/error.h"

namespace talus {

std::string read_file(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) -> Error {
    return input_error(fmt::format("{}: cannot read: {}", path.string(), reason));
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw refuse("no such file");
  if (std::filesystem::is_directory(status)) throw refuse("it is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw refuse("not a regular file");

  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw refuse(std::generic_category().message(errno));
  std::string bytes(std::filesystem::file_size(path, error), '\0');
  std::size_t done = 0;
  int reason = 0;
  while (done < bytes.size() && reason == 0) {
    const ssize_t n = ::read(descriptor, bytes.data() + done, bytes.size() - done);
    if (n == 0) bytes.resize(done);  // it shrank meanwhile
    if (n < 0 && errno != EINTR) reason = errno;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  ::close(descriptor);
  if (reason != 0) throw refuse(std::generic_category().message(reason));
  return bytes;
}

}  // namespace talus
