#include "talus/scene/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "talus/io/read_file.h"
#include "talus/scene/outputs.h"
#include "temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

// Names as the cache gives them.
const std::string kA = std::string(32, 'a') + ".pile";
const std::string kB = std::string(32, 'b') + ".tiles";
const std::string kC = std::string(32, 'c') + ".pile";

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
  EXPECT_FALSE(ask(cache, kA, "one"));
  EXPECT_TRUE(ask(cache, kA, "one"));
  EXPECT_FALSE(ask(cache, kB, "two"));
}

TEST(Cache, WithoutAFolderKeepsNothing) {
  Cache cache(std::nullopt, 1000);
  EXPECT_FALSE(ask(cache, kA, "one"));
  EXPECT_FALSE(ask(cache, kA, "one"));
}

TEST(Cache, DropsWhatWasUnusedForLongest) {
  const TemporaryFolder folder;
  Cache cache(folder.path(), 25);
  const std::string ten = "0123456789";
  ask(cache, kA, ten);
  ask(cache, kB, ten);
  set_age(folder / kA, 2);
  set_age(folder / kB, 1);
  EXPECT_TRUE(ask(cache, kA, ten));  // now b is the older one
  EXPECT_FALSE(ask(cache, kC, ten));
  EXPECT_TRUE(fs::exists(folder / kA));
  EXPECT_FALSE(fs::exists(folder / kB));
  EXPECT_TRUE(fs::exists(folder / kC));
}

TEST(Cache, KeepsTheNewestHoweverLarge) {
  const TemporaryFolder folder;
  Cache cache(folder.path(), 5);
  ask(cache, kA, "0123456789");
  EXPECT_TRUE(ask(cache, kA, "0123456789"));
}

TEST(Cache, LeavesTheFilesOfOthersAlone) {
  const TemporaryFolder folder;
  const std::string ten = "0123456789";
  const std::string digits(32, 'd');
  const std::vector<std::string> others = {
      "thesis.doc",      "notes.pile",           digits,  digits + ".piles",
      digits + "d.pile", digits + ".txt.0.part", "a.part"};
  for (const std::string& name : others) {
    write_text(folder / name, ten);
    set_age(folder / name, 1000);
  }
  Cache cache(folder.path(), 15);
  ask(cache, kA, ten);
  set_age(folder / kA, 1);
  ask(cache, kB, ten);
  EXPECT_FALSE(fs::exists(folder / kA));
  EXPECT_TRUE(fs::exists(folder / kB));
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(Cache, DropsWhatKilledRunsLeftUnfinished) {
  const TemporaryFolder folder;
  const std::string stale = kA + ".0.part", fresh = kC + ".1.part";
  for (const std::string& name : {stale, fresh}) write_text(folder / name, "half");
  set_age(folder / stale, 48);
  Cache cache(folder.path(), 1000);
  ask(cache, kB, "whole");
  EXPECT_FALSE(fs::exists(folder / stale));
  EXPECT_TRUE(fs::exists(folder / fresh)) << "another run may still write it";
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
