#include "talus/piles/cube_bits.h"

#include <gtest/gtest.h>

#include <map>

#include "talus/base/hash.h"

namespace talus {
namespace {

TEST(CubeBits, HoldsWhatAMapWouldHold) {
  CubeBits bits(3);
  std::map<std::array<int, 3>, std::array<std::uint64_t, 3>> expected;  // by z, y, x
  for (int i = 0; i < 2000; ++i) {
    const auto draw = [&](int what) { return hash(5, Purpose::seed_position, i, what); };
    const Int3 cube(static_cast<int>(draw(0) % 5) - 2, static_cast<int>(draw(1) % 5) - 2,
                    static_cast<int>(draw(2) % 5) - 2);
    std::array<std::uint64_t, 3> words = {draw(3), 0, draw(4)};
    if (draw(5) % 3 == 0) words = {};
    bits.put(cube, words);
    if (words == std::array<std::uint64_t, 3>{})
      expected.erase({cube.z, cube.y, cube.x});
    else
      expected[{cube.z, cube.y, cube.x}] = words;
  }
  ASSERT_EQ(bits.size(), expected.size());
  std::size_t i = 0;
  std::uint64_t count = 0;
  CubeBits appended(3);
  for (const auto& [place, words] : expected) {
    const Int3 cube(place[2], place[1], place[0]);
    EXPECT_EQ(bits.cube(i), cube);
    EXPECT_EQ(bits.find(cube), i);
    EXPECT_TRUE(std::equal(words.begin(), words.end(), bits.words(i).begin()));
    for_each_bit(bits.words(i), [&](std::uint32_t number) {
      EXPECT_TRUE(test_bit(words, number));
      ++count;
    });
    appended.append(cube, words);
    ++i;
  }
  EXPECT_EQ(appended, bits);
  EXPECT_EQ(bits.bit_count(), count);
  EXPECT_FALSE(bits.find({9, 9, 9}));
}

}  // namespace
}  // namespace talus
