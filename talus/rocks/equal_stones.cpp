#include "talus/rocks/equal_stones.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"

namespace talus::rocks {

std::vector<std::uint32_t> find_equal_stones(const BlockTable& blocks,
                                             std::span<const StoneKey> stones) {
  std::vector<StonePrint> prints(stones.size());
  tbb::enumerable_thread_specific<StoneGrid> grids;
  constexpr std::size_t kGrain = 64;
  parallel_for(
      stones.size(),
      [&](std::size_t i) {
        StoneGrid& grid = grids.local();
        grid.find_pieces(blocks, stones[i]);
        const std::size_t cell = blocks.layout().cell_index(stones[i].cell);
        StonePrint print = {cell, cell};
        for (const StoneGrid::Piece& piece : grid.pieces()) {
          if (!piece.self) continue;
          // Seeds are told apart by where they are kept.
          const auto seed =
              reinterpret_cast<std::uintptr_t>(piece.block->candidates[*piece.self].form);
          const StonePrint& part = piece.block->prints[*piece.self];
          for (std::size_t k = 0; k < 2; ++k)
            print[k] = extend(print[k], static_cast<std::int64_t>(part[k] + seed));
        }
        prints[i] = print;
      },
      kGrain);

  std::vector<std::uint32_t> order(stones.size()), first(stones.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(prints[a], a) < std::tie(prints[b], b);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    const bool is_new = k == 0 || prints[order[k - 1]] != prints[i];
    first[i] = is_new ? i : first[order[k - 1]];
  }
  return first;
}

}  // namespace talus::rocks
