#include "talus/scene/terrain_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "talus/base/error.h"
#include "talus/io/read_file.h"
#include "temporary_folder.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

TerrainStage random_stage(int nx) {
  const TerrainGrid grid{.nx = nx, .ny = 5, .cell = 0.5, .step = 0.01, .origin_x = 3, .floor = -20};
  Booking booking;
  booking.replace(Material::air, Material::sand, 17);
  return {test::random_stacks(4, grid), booking, true};
}

TEST(TerrainFile, GivesBackWhatWasSaved) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "one.terrain";
  const TerrainStage stage = random_stage(70);
  save_terrain(path, stage);
  const TerrainStage again = load_terrain(path);
  EXPECT_EQ(again.terrain, stage.terrain);
  EXPECT_EQ(again.booking, stage.booking);
  EXPECT_TRUE(again.balanced);
}

TEST(TerrainFile, EveryCutAndEveryFlippedByteIsFound) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "one.terrain";
  save_terrain(path, random_stage(3));
  const std::string bytes = read_file(path);
  const auto refused = [&](const std::string& changed) {
    std::ofstream(path, std::ios::binary) << changed;
    EXPECT_THROW(load_terrain(path), Error);
  };
  for (std::size_t size = 0; size < bytes.size(); ++size) refused(bytes.substr(0, size));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    refused(changed);
  }
}

}  // namespace
}  // namespace talus
