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

// A regular file opened for reading, closed at the end whatever happens.
class InputFile {
 public:
  // Throws `Error` (input).
  explicit InputFile(const std::filesystem::path& path) : path_(path) {
    // Without O_NONBLOCK, opening a pipe would wait for its writer.
    number_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (number_ < 0) throw refusal(errno == ENOENT ? "no such file" : system_reason());
    try {
      struct stat status {};
      if (::fstat(number_, &status) != 0) throw refusal(system_reason());
      if (S_ISDIR(status.st_mode)) throw refusal("it is a folder, not a file");
      if (!S_ISREG(status.st_mode)) throw refusal("not a regular file");
      size_ = static_cast<std::size_t>(status.st_size);
    } catch (...) {
      ::close(number_);
      throw;
    }
  }
  ~InputFile() { ::close(number_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::string read() const {
    std::string bytes(size_, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n = ::read(number_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno != EINTR) throw refusal(system_reason());
      if (n == 0) bytes.resize(done);  // it shrank meanwhile
      if (n > 0) done += static_cast<std::size_t>(n);
    }
    return bytes;
  }

 private:
  static std::string system_reason() { return std::generic_category().message(errno); }
  Error refusal(std::string_view reason) const {
    return input_error(fmt::format("{}: cannot read: {}", path_.string(), reason));
  }

  const std::filesystem::path& path_;
  int number_ = -1;
  std::size_t size_ = 0;
};

}  // namespace

std::string read_file(const std::filesystem::path& path) { return InputFile(path).read(); }

void check_readable_file(const std::filesystem::path& path) { InputFile{path}; }

}  // namespace talus
