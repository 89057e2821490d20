#include "talus/io/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "talus/base/error.h"

namespace talus {
namespace {

// An open file, closed at the end whatever happens.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view reason) {
    return input_error(fmt::format("{}: cannot read: {}", path.string(), reason));
  };
  const auto system_reason = [] { return std::generic_category().message(errno); };

  // Without O_NONBLOCK, opening a pipe would wait for its writer.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
  if (file.number < 0) throw refuse(errno == ENOENT ? "no such file" : system_reason());
  struct stat status {};
  if (::fstat(file.number, &status) != 0) throw refuse(system_reason());
  if (S_ISDIR(status.st_mode)) throw refuse("it is a folder, not a file");
  if (!S_ISREG(status.st_mode)) throw refuse("not a regular file");

  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::read(file.number, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) throw refuse(system_reason());
    if (n == 0) bytes.resize(done);  // it shrank meanwhile
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace talus
