#include "talus/scene/output_params.h"

#include <gtest/gtest.h>

#include <set>

#include "talus/scene/outputs.h"
#include "temporary_folder.h"

namespace talus {
namespace {

OutputParams read(std::string_view text) {
  const std::string recipe =
      "[[operation]]\ntype = \"pile\"\nsupport = { shape = \"sphere\" }\n[output]\n";
  return read_recipe(parse_document(recipe + std::string(text), "scene.toml")).output;
}

TEST(Output, WithoutATargetIsAnInstancedGlb) {
  EXPECT_EQ(formats_of({}), std::vector{Format::glb});
  EXPECT_EQ(instances_of({}), InstanceMode::gpu);
  EXPECT_FALSE(objects_max({}));
}

TEST(Output, EveryTargetGetsWhatItReads) {
  // Neither Blender nor Godot knows EXT_mesh_gpu_instancing by itself.
  for (const char* name : {"blender", "godot"}) {
    const OutputParams output = read(fmt::format("for = \"{}\"", name));
    EXPECT_EQ(formats_of(output), std::vector{Format::glb});
    EXPECT_EQ(instances_of(output), InstanceMode::nodes);
    EXPECT_TRUE(objects_max(output));
  }
  for (const char* name : {"unreal", "houdini", "isaac"})
    EXPECT_EQ(formats_of(read(fmt::format("for = \"{}\"", name))), std::vector{Format::usda});
}

TEST(Output, WhatIsGivenWinsOverTheTarget) {
  const OutputParams output =
      read("for = \"blender\"\nformats = [\"glb\", \"csv\"]\ninstances = \"gpu\"");
  EXPECT_EQ(formats_of(output), (std::vector{Format::glb, Format::csv}));
  EXPECT_EQ(instances_of(output), InstanceMode::gpu);
  EXPECT_FALSE(objects_max(output)) << "points are no objects";
  EXPECT_FALSE(objects_max(read("for = \"blender\"\nformats = [\"csv\"]")));
}

TEST(Output, NoTwoFormatsShareAFile) {
  std::set<std::string_view> names;
  for (const auto& [format, name] : kEnumNames<Format>) names.insert(file_name(format));
  EXPECT_EQ(names.size(), kEnumNames<Format>.size());
}

// Keeps what is warned of.
class Listener : public Job {
 public:
  void warn(std::string_view message) override { warnings.emplace_back(message); }
  std::vector<std::string> warnings;
};

TEST(Output, WarnsOfMoreObjectsThanATargetOpens) {
  const TemporaryFolder folder;
  BuildResult result;
  result.piles.resize(1);
  result.stones.prototypes = {std::make_shared<TriangleMesh>(
      TriangleMesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}})};
  result.stones.instances.resize(20'001);
  const auto warnings_for = [&](std::string_view target) {
    result.recipe.output = read(fmt::format("for = \"{}\"", target));
    Listener job;
    write_scene(result, folder.path(), &job);
    return job.warnings;
  };
  const std::vector<std::string> warnings = warnings_for("godot");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("20001 stones are more objects than godot")) << warnings[0];
  EXPECT_TRUE(warnings_for("blender").empty());
  EXPECT_TRUE(warnings_for("houdini").empty());
}

}  // namespace
}  // namespace talus
