#include "talus/io/mask_reader.h"

#include <gtest/gtest.h>

#include "io/scratch.h"
#include "talus/base/error.h"
#include "talus/io/png.h"

namespace talus {
namespace {

TEST(ReadMask, RunsFromTheSouthWestAndTakesTheMeanOfColors) {
  const test::Scratch scratch;
  write_png(scratch.path("grey.png"),
            {.width = 2, .height = 2, .channels = 1, .pixels = {0, 51, 102, 255}});
  const ColumnMask grey = read_mask(scratch.path("grey.png"));
  EXPECT_EQ(grey.nx, 2);
  EXPECT_EQ(grey.ny, 2);
  EXPECT_EQ(grey.shares, (std::vector<float>{0.4f, 1, 0, 0.2f}));

  write_png(scratch.path("color.png"),
            {.width = 2, .height = 1, .channels = 4, .pixels = {51, 102, 0, 9, 255, 255, 255, 0}});
  EXPECT_EQ(read_mask(scratch.path("color.png")).shares, (std::vector<float>{0.2f, 1}));
}

TEST(ReadMask, RefusesWhatIsNoPicture) {
  const test::Scratch scratch;
  EXPECT_THROW(read_mask(scratch.path("none.png")), Error);
}

}  // namespace
}  // namespace talus
