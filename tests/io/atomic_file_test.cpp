#include "talus/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "io/scratch.h"

namespace talus {
namespace {

using test::bytes_of;
using test::Refusal;
using test::refusal_of;
using test::Scratch;

TEST(AtomicFile, AppearsOnlyWithCommit) {
  const Scratch scratch;
  {
    AtomicFile file(scratch.path("a.txt"));
    file.write("hello");
    EXPECT_FALSE(std::filesystem::exists(scratch.path("a.txt")));
    file.commit();
  }
  EXPECT_EQ(bytes_of(scratch.path("a.txt")), "hello");
  EXPECT_EQ(scratch.file_count(), 1u);
}

TEST(AtomicFile, KeepsMoreThanOneBuffer) {
  const Scratch scratch;
  const std::string text(1'000'003, 'x');
  AtomicFile file(scratch.path("a.txt"));
  file.write("begin");
  file.write(text);
  EXPECT_EQ(file.size(), text.size() + 5);
  file.commit();
  EXPECT_EQ(bytes_of(scratch.path("a.txt")), "begin" + text);
}

TEST(AtomicFile, WithoutCommitLeavesTheOlderFile) {
  const Scratch scratch;
  scratch.file("a.txt", "old");
  { AtomicFile(scratch.path("a.txt")).write("new"); }
  EXPECT_EQ(bytes_of(scratch.path("a.txt")), "old");
  EXPECT_EQ(scratch.file_count(), 1u);
}

TEST(AtomicFile, TwoWritersDoNotMix) {
  const Scratch scratch;
  AtomicFile one(scratch.path("a.txt")), two(scratch.path("a.txt"));
  one.write("one");
  two.write("two");
  two.commit();
  one.commit();
  EXPECT_EQ(bytes_of(scratch.path("a.txt")), "one");
  EXPECT_EQ(scratch.file_count(), 1u);
}

TEST(AtomicFile, NamesWhyAPathCannotBeWritten) {
  const Scratch scratch;
  const auto line = [&](const std::filesystem::path& path) {
    const Refusal refusal = refusal_of([&] { AtomicFile file(path); });
    EXPECT_EQ(refusal.kind, ErrorKind::job);
    EXPECT_NE(refusal.line.find(path.string()), std::string::npos) << refusal.line;
    return refusal.line;
  };
  scratch.file("file", "");
  EXPECT_NE(line(scratch.path("missing/a.txt")).find("No such file"), std::string::npos);
  EXPECT_NE(line(scratch.path("file/a.txt")).find("Not a directory"), std::string::npos);
  EXPECT_NE(line(scratch.path(".")).find("Is a directory"), std::string::npos);
  EXPECT_NE(line("/dev/full").find("not a regular file"), std::string::npos);
}

// A limit on file size fails `write` as a full disk does, and needs no privilege.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(AtomicFile, AFailedWriteLeavesNothing) {
  const Scratch scratch;
  Refusal refusal;
  {
    const FileSizeLimit limit(1 << 20);
    refusal = refusal_of([&] {
      AtomicFile file(scratch.path("a.bin"));
      file.write(std::string(3 << 20, 'x'));
      file.commit();
    });
  }
  EXPECT_EQ(refusal.kind, ErrorKind::job);
  EXPECT_NE(refusal.line.find("File too large"), std::string::npos) << refusal.line;
  EXPECT_EQ(scratch.file_count(), 0u);
}

}  // namespace
}  // namespace talus
