#include "talus/mesh/grid_rows.h"

#include <gtest/gtest.h>

#include <queue>

#include "talus/base/hash.h"

namespace talus {
namespace {

// Samples of a grid, 1 inside; its border is outside.
struct Samples {
  Int3 size;
  std::vector<std::uint8_t> inside;

  std::size_t index(const Int3& p) const {
    return static_cast<std::size_t>(p.x + size.x * (p.y + size.y * p.z));
  }
  GridRows rows() const {
    GridBits bits;
    bits.assign(inside);
    GridRows result;
    result.assign(size, bits);
    return result;
  }
  void for_each(auto&& use) const {
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) use(Int3(x, y, z));
  }
};

Samples random_samples(const Int3& size, std::uint64_t seed, double share) {
  Samples s{size, {}};
  s.for_each([&](const Int3& p) {
    const Int3 from_end = size - 1 - p;
    const bool border = std::min({p.x, p.y, p.z, from_end.x, from_end.y, from_end.z}) == 0;
    s.inside.push_back(!border && uniform(hash(seed, Purpose::weathering, p.x, p.y, p.z)) < share);
  });
  return s;
}

// Flooded sample by sample.
std::vector<std::uint8_t> largest_piece(const Samples& s) {
  std::vector<std::uint8_t> left = s.inside, largest(left.size());
  std::size_t most = 0;
  s.for_each([&](const Int3& start) {
    if (!left[s.index(start)]) return;
    std::vector<std::uint8_t> piece(left.size());
    std::size_t count = 0;
    std::queue<Int3> open({start});
    left[s.index(start)] = 0;
    for (; !open.empty(); open.pop()) {
      piece[s.index(open.front())] = 1;
      ++count;
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Int3 next = open.front();
          next[axis] += step;
          if (!left[s.index(next)]) continue;
          left[s.index(next)] = 0;
          open.push(next);
        }
    }
    if (count <= most) return;
    most = count;
    largest = piece;
  });
  return largest;
}

// Rows of less than a word, of exactly one and of several; few, many and nearly all inside.
class GridRowsOf : public testing::TestWithParam<std::tuple<int, double>> {
 protected:
  Samples samples(std::uint64_t seed) const {
    const auto [size_x, share] = GetParam();
    return random_samples({size_x, 9, 8}, seed, share);
  }
};

TEST_P(GridRowsOf, KeepTheLargestPieceAndCountTheRest) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Samples s = samples(seed);
    const std::vector<std::uint8_t> expected = largest_piece(s);
    GridRows rows = s.rows();
    const std::size_t taken = rows.keep_largest_piece();
    EXPECT_EQ(taken, static_cast<std::size_t>(std::count(s.inside.begin(), s.inside.end(), 1) -
                                              std::count(expected.begin(), expected.end(), 1)));
    s.for_each([&](const Int3& p) { ASSERT_EQ(rows.inside(p), expected[s.index(p)] == 1) << p.x; });
  }
}

TEST_P(GridRowsOf, PackWhatTheirBoxHolds) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Samples s = samples(seed);
    const GridRows rows = s.rows();
    const GridRows::Box box = rows.box();
    const std::vector<std::uint64_t> packed = rows.packed(box);
    Int3 low = s.size, high(-1);
    s.for_each([&](const Int3& p) {
      if (!s.inside[s.index(p)]) return;
      low = glm::min(low, p);
      high = glm::max(high, p);
    });
    ASSERT_EQ(box.min, low);
    ASSERT_EQ(box.size, high - low + 1);
    std::size_t i = 0;
    for (int z = 0; z < box.size.z; ++z)
      for (int y = 0; y < box.size.y; ++y)
        for (int x = 0; x < box.size.x; ++x, ++i)
          ASSERT_EQ(packed[i / 64] >> (i % 64) & 1, s.inside[s.index(box.min + Int3(x, y, z))]);
    ASSERT_EQ(packed.size(), (i + 63) / 64);
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, GridRowsOf,
                         testing::Combine(testing::Values(7, 64, 65, 150),
                                          testing::Values(0.1, 0.35, 0.5, 0.9)));

TEST(GridRows, OfNothingHaveAnEmptyBox) {
  GridRows rows = random_samples({9, 5, 4}, 1, 0).rows();
  EXPECT_EQ(rows.keep_largest_piece(), 0u);
  EXPECT_EQ(rows.box().size, Int3(0));
}

}  // namespace
}  // namespace talus
