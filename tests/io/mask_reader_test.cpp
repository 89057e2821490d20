#include "talus/io/mask_reader.h"

#include <gtest/gtest.h>

#include "io/scratch.h"
#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/io/png.h"

namespace talus {
namespace {

TEST(ReadMask, RunsFromTheSouthWestAndTakesTheMeanOfColors) {
  const test::Scratch scratch;
  write_png(scratch.path("grey.png"),
            {.width = 2, .height = 2, .channels = 1, .pixels = {0, 51, 102, 255}});
  const ColumnMask grey = read_mask(scratch.path("grey.png"), 2, 2);
  EXPECT_EQ(grey.nx, 2);
  EXPECT_EQ(grey.ny, 2);
  EXPECT_EQ(grey.shares, (std::vector<float>{0.4f, 1, 0, 0.2f}));

  write_png(scratch.path("color.png"),
            {.width = 2, .height = 1, .channels = 4, .pixels = {51, 102, 0, 9, 255, 255, 255, 0}});
  EXPECT_EQ(read_mask(scratch.path("color.png"), 2, 1).shares, (std::vector<float>{0.2f, 1}));
}

TEST(ReadMask, RefusesWhatIsNoPicture) {
  const test::Scratch scratch;
  EXPECT_THROW(read_mask(scratch.path("none.png"), 2, 2), Error);
}

TEST(ReadMask, RefusesOtherSizesBeforeItReadsPixels) {
  const test::Scratch scratch;
  Image noise{.width = 64, .height = 48, .channels = 1};
  for (int i = 0; i < 64 * 48; ++i)
    noise.pixels.push_back(static_cast<std::uint8_t>(hash(1, Purpose::texture, i)));
  write_png(scratch.path("noise.png"), noise);
  const std::string bytes = test::bytes_of(scratch.path("noise.png"));
  const auto cut = scratch.file("cut.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(test::refusal_of([&] { read_mask(cut, 64, 48); }).kind, ErrorKind::input);
  const test::Refusal refusal = test::refusal_of([&] { read_mask(cut, 64, 47); });
  EXPECT_EQ(refusal.kind, ErrorKind::usage);
  EXPECT_EQ(refusal.line, cut.string() +
                              ": a mask of 64 x 48 pixels; it must have one for each column of the "
                              "terrain, 64 x 47");
}

}  // namespace
}  // namespace talus
