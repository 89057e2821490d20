#include "talus/scene/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "scene/temporary_folder.h"
#include "talus/io/read_file.h"
#include "talus/scene/outputs.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

// Asks for an entry of that text; whether it was there.
bool ask(Cache& cache, const std::string& key, const std::string& text) {
  bool hit = false;
  const std::string got = cache.load_or_make(
      key, [](const fs::path& path) { return read_file(path); }, [&] { return text; },
      [](const fs::path& path, const std::string& made) { write_text(path, made); }, hit, nullptr);
  EXPECT_EQ(got, text);
  return hit;
}

void set_age(const fs::path& file, int hours) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
}

TEST(Cache, KeepsWhatItMade) {
  const TemporaryFolder folder;
  Cache cache(folder / "deep/cache", 1000);
  EXPECT_FALSE(ask(cache, "a", "one"));
  EXPECT_TRUE(ask(cache, "a", "one"));
  EXPECT_FALSE(ask(cache, "b", "two"));
}

TEST(Cache, WithoutAFolderKeepsNothing) {
  Cache cache(std::nullopt, 1000);
  EXPECT_FALSE(ask(cache, "a", "one"));
  EXPECT_FALSE(ask(cache, "a", "one"));
}

TEST(Cache, DropsWhatWasUnusedForLongest) {
  const TemporaryFolder folder;
  Cache cache(folder.path(), 25);
  const std::string ten = "0123456789";
  ask(cache, "a", ten);
  ask(cache, "b", ten);
  set_age(folder / "a", 2);
  set_age(folder / "b", 1);
  EXPECT_TRUE(ask(cache, "a", ten));  // now b is the older one
  EXPECT_FALSE(ask(cache, "c", ten));
  EXPECT_TRUE(fs::exists(folder / "a"));
  EXPECT_FALSE(fs::exists(folder / "b"));
  EXPECT_TRUE(fs::exists(folder / "c"));
}

TEST(Cache, KeepsTheNewestHoweverLarge) {
  const TemporaryFolder folder;
  Cache cache(folder.path(), 5);
  ask(cache, "a", "0123456789");
  EXPECT_TRUE(ask(cache, "a", "0123456789"));
}

TEST(Cache, FolderComesFromTheEnvironment) {
  const auto folder = [](const char* own, const char* base, const char* home) {
    const auto set = [](const char* name, const char* value) {
      if (value)
        setenv(name, value, 1);
      else
        unsetenv(name);
    };
    set("TALUS_CACHE_DIR", own);
    set("XDG_CACHE_HOME", base);
    set("HOME", home);
    return default_cache_folder();
  };
  EXPECT_EQ(folder("/own", "/base", "/home/a"), "/own");
  EXPECT_EQ(folder(nullptr, "/base", "/home/a"), "/base/talus");
  EXPECT_EQ(folder(nullptr, nullptr, "/home/a"), "/home/a/.cache/talus");
  EXPECT_EQ(folder(nullptr, nullptr, nullptr), "");
}

}  // namespace
}  // namespace talus
