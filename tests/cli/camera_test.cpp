// Who places the camera when recipe and command line both say something.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace talus {
namespace {

using Names = std::vector<std::string>;

// The [view] that remains of a recipe's after the command line had its say.
class View {
 public:
  explicit View(const std::string& view) { work_.write("a.toml", kSmallRecipe + view); }

  std::string with(const Names& words) const {
    Names all = {"build", "a.toml", "-o", "out", "--no-preview", "--save-scene", "saved.toml"};
    for (const std::string& word : words) {
      all.push_back("--set");
      all.push_back("view." + word);
    }
    const RunResult result = work_.talus(all);
    if (result.status != 0) return result.error;
    const std::string saved = work_.read("saved.toml");
    const std::size_t begin = saved.find("[view]\n");
    return begin == std::string::npos ? "" : saved.substr(begin + 7);
  }

  const Workplace& work() const { return work_; }

 private:
  Workplace work_;
};

constexpr const char* kByHand = "[view]\neye = [9, 0, 3]\ntarget = [0, 0, 1]\nwidth = 64\n";

TEST(CliCamera, AnglesZoomAndPresetReplaceTheRecipesEye) {
  const View view(kByHand);
  EXPECT_EQ(view.with({}), "width = 64\neye = [9.0, 0.0, 3.0]\ntarget = [0.0, 0.0, 1.0]\n");
  EXPECT_EQ(view.with({"azimuth_deg=120"}), "width = 64\nazimuth_deg = 120.0\n");
  EXPECT_EQ(view.with({"elevation_deg=40"}), "width = 64\nelevation_deg = 40.0\n");
  EXPECT_EQ(view.with({"zoom=2"}), "width = 64\nzoom = 2.0\n");
  EXPECT_EQ(view.with({"camera=overview"}), "width = 64\n");
  EXPECT_EQ(view.with({"camera=low"}), "camera = \"low\"\nwidth = 64\n");
}

TEST(CliCamera, WhatDoesNotPlaceItLeavesTheEye) {
  const View view(kByHand);
  EXPECT_EQ(view.with({"field_of_view_deg=60"}),
            "width = 64\nfield_of_view_deg = 60.0\neye = [9.0, 0.0, 3.0]\n"
            "target = [0.0, 0.0, 1.0]\n");
  EXPECT_EQ(view.with({"camera=inside", "eye=[1,1,1]"}),
            "camera = \"inside\"\nwidth = 64\neye = [1.0, 1.0, 1.0]\ntarget = [0.0, 0.0, 1.0]\n");
}

TEST(CliCamera, AnEyeReplacesTheRecipesAngles) {
  const View view("[view]\nazimuth_deg = 30\nelevation_deg = 50\nzoom = 2\n");
  EXPECT_EQ(view.with({"eye=[1,1,1]", "target=[0,0,0]"}),
            "eye = [1.0, 1.0, 1.0]\ntarget = [0.0, 0.0, 0.0]\n");
  EXPECT_EQ(view.with({"azimuth_deg=10"}),
            "azimuth_deg = 10.0\nelevation_deg = 50.0\nzoom = 2.0\n");
  EXPECT_EQ(view.with({"camera=low"}), "camera = \"low\"\nazimuth_deg = 30.0\n");
}

TEST(CliCamera, PresetsThatNeedAnEyeOrChooseTheHeightGiveWayToo) {
  EXPECT_EQ(View("[view]\ncamera = \"inside\"\neye = [9, 0, 3]\ntarget = [0, 0, 1]\n")
                .with({"azimuth_deg=10"}),
            "azimuth_deg = 10.0\n");
  EXPECT_EQ(View("[view]\ncamera = \"low\"\n").with({"azimuth_deg=10"}),
            "camera = \"low\"\nazimuth_deg = 10.0\n");
  EXPECT_EQ(View("[view]\ncamera = \"low\"\n").with({"zoom=3"}), "zoom = 3.0\n");
}

TEST(CliCamera, ContradictionsOfTheCommandLineAreRefused) {
  const std::string line = View(kByHand).with({"eye=[1,1,1]", "zoom=2"});
  EXPECT_EQ(line,
            "talus: error: --set view.zoom=2: view.zoom: has no effect beside \"eye\"; leave one "
            "of them out\n");
}

TEST(CliCamera, RenderOfAFolderHearsItsOptions) {
  const View view(kByHand);
  const Workplace& work = view.work();
  ASSERT_EQ(work.talus({"build", "a.toml", "-o", "out", "--no-preview"}).status, 0);
  const auto picture = [&](const Names& options) {
    Names words = {"render", "out", "-o", "a.png", "--height", "48", "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    const RunResult result = work.talus(words);
    EXPECT_EQ(result.status, 0) << result.error;
    return work.read("a.png");
  };
  const std::string by_hand = picture({});
  EXPECT_NE(picture({"--azimuth-deg", "120"}), by_hand);
  EXPECT_NE(picture({"--zoom", "2"}), picture({"--zoom", "1"}));
  EXPECT_NE(picture({"--eye", "9,0,5"}), by_hand);
  EXPECT_EQ(picture({"--eye", "9,0,3", "--target", "0,0,1"}), by_hand);
}

}  // namespace
}  // namespace talus
