#include "talus/io/read_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "io/scratch.h"

namespace talus {
namespace {

TEST(ReadFile, TellsWhyItCannot) {
  const test::Scratch scratch;
  EXPECT_EQ(read_file(scratch.file("a", "text")), "text");
  const auto pipe = scratch.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::pair<std::filesystem::path, std::string> cases[] = {
      {scratch.path("none"), "no such file"},
      {scratch.path("a/below"), "Not a directory"},
      {scratch.path(""), "it is a folder, not a file"},
      {pipe, "not a regular file"},
      {scratch.path(std::string(300, 'x')), "File name too long"},
  };
  for (const auto& [path, reason] : cases) {
    const test::Refusal refusal = test::refusal_of([&] { read_file(path); });
    EXPECT_EQ(refusal.kind, ErrorKind::input);
    EXPECT_EQ(refusal.line, path.string() + ": cannot read: " + reason);
  }
}

}  // namespace
}  // namespace talus
