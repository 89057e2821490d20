#include "talus/base/hash.h"

#include <gtest/gtest.h>

#include <vector>

namespace talus {
namespace {

TEST(Hash, DependsOnEveryArgument) {
  const std::uint64_t h = hash(1, Purpose::seed_size, 2, 3, 4);
  EXPECT_NE(h, hash(2, Purpose::seed_size, 2, 3, 4));
  EXPECT_NE(h, hash(1, Purpose::seed_axes, 2, 3, 4));
  EXPECT_NE(h, hash(1, Purpose::seed_size, 3, 2, 4));
  EXPECT_NE(h, hash(1, Purpose::seed_size, 2, 3));
}

TEST(Hash, NeverChangesBetweenVersions) {
  EXPECT_EQ(hash(1, Purpose::corner_color, -1, 0, 7), hash(1, Purpose::corner_color, -1L, 0L, 7L));
  EXPECT_EQ(mix_bits(1), 0x5692161d100b05e5u);
}

TEST(Hash, UniformFillsTheUnitIntervalEvenly) {
  constexpr int kBins = 16, kDraws = 1 << 16;
  std::vector<int> bins(kBins);
  for (int i = 0; i < kDraws; ++i) {
    const double u = uniform(hash(7, Purpose::seed_position, i));
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++bins[static_cast<std::size_t>(u * kBins)];
  }
  // Chi-squared with 15 degrees of freedom exceeds 37.7 once in a thousand.
  double chi2 = 0;
  for (const int n : bins) chi2 += (n - 4096.0) * (n - 4096.0) / 4096.0;
  EXPECT_LT(chi2, 37.7);
}

TEST(Digest, SeparatesWhatWasAddedApart) {
  const auto digest = [](std::initializer_list<std::string_view> parts) {
    Digest d;
    for (const std::string_view part : parts) d.add(part);
    return d.hex();
  };
  EXPECT_EQ(digest({"ab", "c"}), digest({"ab", "c"}));
  EXPECT_NE(digest({"ab", "c"}), digest({"a", "bc"}));
  EXPECT_EQ(digest({"x"}).size(), 32u);
}

}  // namespace
}  // namespace talus
