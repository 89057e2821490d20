// What `render` shows of results.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/program.h"
#include "talus/io/image_reader.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

const std::string kPlace = R"(
[terrain]
size = [12, 9]
[[operation]]
type = "noise_terrain"
relief = 2
feature_size = 6
[[operation]]
type = "cover"
material = "snow"
coverage = 0.5
patch_size = 3
[[operation]]
type = "primitive"
material = "rocks"
replaces = ["air"]
support = { shape = "sphere", center = [6, 4, 2], radius = 2 }
[[operation]]
type = "pile"
support = "rocks"
stone_size = 0.8
[view]
width = 160
height = 120
)";

// Mean difference of two pictures' bytes.
double difference(const fs::path& a, const fs::path& b) {
  const Image first = read_image(a), second = read_image(b);
  EXPECT_EQ(first.pixels.size(), second.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < std::min(first.pixels.size(), second.pixels.size()); ++i)
    sum += std::abs(first.pixels[i] - second.pixels[i]);
  return sum / static_cast<double>(first.pixels.size());
}

TEST(CliRender, ResultsAreShownWhereverTheyLie) {
  const Workplace work;
  work.write("place.toml", kPlace);
  ASSERT_EQ(work.talus({"build", "place.toml", "-o", "out", "--quiet"}).status, 0);
  fs::rename(work.path("out"), work.path("moved"));
  fs::remove(work.path("place.toml"));

  const RunResult folder = work.talus({"render", "moved", "-o", "folder.png", "--no-cache"});
  ASSERT_EQ(folder.status, 0) << folder.error;
  EXPECT_LT(difference(work.path("folder.png"), work.path("moved/preview.png")), 0.5);

  // The file alone knows the materials too, only not how it was looked at.
  const RunResult file = work.talus(
      {"render", "moved/scene.glb", "-o", "file.png", "--width", "160", "--height", "120"});
  ASSERT_EQ(file.status, 0) << file.error;
  EXPECT_LT(difference(work.path("file.png"), work.path("moved/preview.png")), 0.5);
}

TEST(CliRender, OtherValuesMakeAnotherScene) {
  const Workplace work;
  work.write("place.toml", kPlace);
  ASSERT_EQ(work.talus({"build", "place.toml", "-o", "out", "--quiet"}).status, 0);
  const RunResult other = work.talus({"render", "out", "-o", "other.png", "--set", "seed=9"});
  ASSERT_EQ(other.status, 0) << other.error;
  EXPECT_GT(difference(work.path("other.png"), work.path("out/preview.png")), 2);
}

}  // namespace
}  // namespace talus
