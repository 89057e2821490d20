// What `render` shows of results.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/program.h"
#include "talus/io/image_reader.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

const std::string kPlace = R"(
[[operation]]
type = "heightmap"
file = "hills.asc"
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

// A hilly raster of 12 x 9 m.
void write_hills(const Workplace& work) {
  std::string text = "ncols 12\nnrows 9\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 12; ++x) text += std::to_string((x * x + 2 * y) % 7 * 0.3) + " ";
    text += "\n";
  }
  work.write("hills.asc", text);
}

// Renders a folder or a file without a cache and compares it with the preview there.
void expect_shown(const Workplace& work, const std::string& subject, const std::string& preview) {
  const RunResult result = work.talus(
      {"render", subject, "-o", "shown.png", "--width", "160", "--height", "120", "--no-cache"});
  ASSERT_EQ(result.status, 0) << result.error;
  EXPECT_LT(difference(work.path("shown.png"), work.path(preview)), 0.5);
}

TEST(CliRender, ResultsAreShownWithoutWhatTheyWereMadeOf) {
  const Workplace work;
  write_hills(work);
  work.write("place.toml", kPlace);
  const RunResult built = work.talus({"build", "place.toml", "-o", "out", "--quiet"});
  ASSERT_EQ(built.status, 0) << built.error;
  fs::rename(work.path("out"), work.path("moved"));
  fs::remove(work.path("hills.asc"));
  expect_shown(work, "moved", "moved/preview.png");
  expect_shown(work, "moved/scene.glb", "moved/preview.png");
}

TEST(CliRender, StonesWithoutGroundStandOnTheirPlane) {
  const Workplace work;
  work.write("box.toml",
             "[[operation]]\ntype = \"pile\"\nsupport = { shape = \"box\" }\n"
             "stone_size = \"30%\"\n[view]\nwidth = 160\nheight = 120\n");
  const RunResult built = work.talus({"build", "box.toml", "-o", "out", "--quiet"});
  ASSERT_EQ(built.status, 0) << built.error;
  expect_shown(work, "out", "out/preview.png");
  expect_shown(work, "out/scene.glb", "out/preview.png");
}

TEST(CliRender, OtherValuesMakeAnotherScene) {
  const Workplace work;
  write_hills(work);
  work.write("place.toml", kPlace);
  ASSERT_EQ(work.talus({"build", "place.toml", "-o", "out", "--quiet"}).status, 0);
  const RunResult other =
      work.talus({"render", "out", "-o", "other.png", "--set", "operation.2.support.radius=3"});
  ASSERT_EQ(other.status, 0) << other.error;
  EXPECT_GT(difference(work.path("other.png"), work.path("out/preview.png")), 2);
}

TEST(CliRender, AnOlderSceneFileIsNotShown) {
  const Workplace work;
  write_hills(work);
  work.write("place.toml", kPlace);
  ASSERT_EQ(work.talus({"build", "place.toml", "-o", "out", "--no-preview"}).status, 0);
  ASSERT_EQ(work.talus({"build", "place.toml", "-o", "out", "--formats", "ply", "--set",
                        "operation.2.support.radius=3"})
                .status,
            0);
  expect_shown(work, "out", "out/preview.png");
}

}  // namespace
}  // namespace talus
