#include "talus/mesh/grid_blur.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "talus/base/hash.h"

namespace talus {
namespace {

// What lies in the working memory beforehand must not matter, nor what lies beyond the grid.
TEST(GridBlur, IsTheWeightedSumWhateverTheScratchHolds) {
  const Int3 size(6, 5, 7);
  const auto at = [&](const Int3& p) {
    return static_cast<std::size_t>(p.x + size.x * (p.y + size.y * p.z));
  };
  const auto is_within = [](const Int3& p, const Int3& low, const Int3& high) {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x < high.x && p.y < high.y &&
           p.z < high.z;
  };
  const auto for_each = [&](auto&& visit) {
    for (int i = 0; i < size.x * size.y * size.z; ++i)
      visit(Int3(i % size.x, i / size.x % size.y, i / (size.x * size.y)));
  };
  std::vector<std::uint16_t> given(static_cast<std::size_t>(size.x * size.y * size.z));
  for_each([&](const Int3& p) {
    if (is_within(p, Int3(1), size - 1))
      given[at(p)] = static_cast<std::uint16_t>(hash(1, Purpose::texture, p.x, p.y, p.z) % 1000);
  });
  for (const int dirt : {0, 12345}) {
    std::vector<std::uint16_t> values = given;
    std::vector<std::uint16_t> scratch(3 * given.size(), static_cast<std::uint16_t>(dirt));
    blur(size, values, scratch);
    for_each([&](const Int3& p) {
      int sum = 0;
      for (int k = 0; k < 27; ++k) {
        const Int3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        if (!is_within(p + step, Int3(0), size)) continue;
        const int away = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
        sum += (8 >> away) * given[at(p + step)];
      }
      ASSERT_EQ(values[at(p)], sum) << p.x << ' ' << p.y << ' ' << p.z;
    });
  }
}

}  // namespace
}  // namespace talus
