// A user's own colors and pictures of the ground's materials.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.h"
#include "talus/base/vec.h"
#include "talus/io/image_reader.h"
#include "talus/io/png.h"

namespace talus {
namespace {

// Level bedrock, seen from above, so that the picture shows nothing else.
const std::string kLevel = R"(
[terrain]
size = [20, 20]
[[operation]]
type = "noise_terrain"
relief = 0.1
[view]
width = 64
height = 48
eye = [10, 9, 9]
target = [10, 10, 0]
)";

void write_plain(const Workplace& work, const std::string& name, std::uint8_t red,
                 std::uint8_t green, std::uint8_t blue) {
  Image image{.width = 8, .height = 8};
  for (int i = 0; i < 8 * 8; ++i) image.pixels.insert(image.pixels.end(), {red, green, blue});
  write_png(work.path(name), image);
}

Vec3 mean_of_picture(const Workplace& work, const std::string& subject) {
  const RunResult result = work.talus({"render", subject, "-o", "picture.png"});
  EXPECT_EQ(result.status, 0) << result.error;
  const Image image = read_image(work.path("picture.png"));
  Vec3 sum(0);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sum[static_cast<int>(i % 3)] += image.pixels[i];
  return sum / (static_cast<double>(image.pixels.size()) / 3);
}

TEST(CliSurfaces, AMaterialShowsTheColorAndThePicturesOfItsTable) {
  const Workplace work;
  std::filesystem::create_directory(work.path("pictures"));
  write_plain(work, "pictures/blue.png", 30, 50, 220);
  work.write("usual.toml", kLevel);
  work.write("color.toml", kLevel + "[surfaces.bedrock]\ncolor = [0.6, 0.05, 0.05]\n");
  work.write("albedo.toml", kLevel + "[surfaces.bedrock]\nalbedo = \"pictures/blue.png\"\n");
  work.write("other.toml", kLevel + "[surfaces.snow]\nalbedo = \"pictures/blue.png\"\n");
  const Vec3 usual = mean_of_picture(work, "usual.toml");
  const Vec3 red = mean_of_picture(work, "color.toml");
  const Vec3 blue = mean_of_picture(work, "albedo.toml");
  EXPECT_LT(usual.b, usual.r + 10);
  EXPECT_GT(red.r, 1.8 * red.b);
  EXPECT_GT(blue.b, 1.8 * blue.r);
  EXPECT_EQ(mean_of_picture(work, "other.toml"), usual) << "there is no snow";

  // A folder of results finds the pictures from where it lies.
  const RunResult built = work.talus({"build", "albedo.toml", "-o", "out/blue", "--no-preview"});
  EXPECT_EQ(built.status, 0) << built.error;
  EXPECT_EQ(mean_of_picture(work, "out/blue"), blue);
}

TEST(CliSurfaces, WhatCannotBeShownIsRefusedInOneLineBeforeTheWork) {
  const Workplace work;
  const auto refusal = [&](const std::string& table, int status) {
    work.write("scene.toml", kLevel + table);
    const RunResult result = work.talus({"build", "scene.toml", "-o", "out"});
    EXPECT_EQ(result.status, status) << result.error;
    EXPECT_FALSE(work.has("out"));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    return result.error;
  };
  EXPECT_NE(refusal("[surfaces.soil]\nnormal = \"none.png\"\n", 3)
                .find("surfaces.soil.normal: none.png: "),
            std::string::npos);
  write_plain(work, "whole.png", 9, 9, 9);
  work.write("cut.png", work.read("whole.png").substr(0, 60));
  EXPECT_NE(
      refusal("[surfaces.ice]\nalbedo = \"cut.png\"\n", 3).find("surfaces.ice.albedo: cut.png"),
      std::string::npos);
  EXPECT_NE(refusal("[surfaces.sand]\ncolor = [0, 2, 0]\n", 2).find("surfaces.sand.color"),
            std::string::npos);
  EXPECT_NE(refusal("[surfaces.sand]\ncolor = [0, 1, 0]\nalbedo = \"whole.png\"\n", 2)
                .find("\"color\" has no effect beside \"albedo\""),
            std::string::npos);
  EXPECT_NE(refusal("[surfaces.water]\nalbedo = \"whole.png\"\n", 2).find("unknown key \"water\""),
            std::string::npos);
}

}  // namespace
}  // namespace talus
