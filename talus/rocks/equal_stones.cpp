#include "talus/rocks/equal_stones.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <tuple>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/rocks/block_faces.h"

namespace talus::rocks {
namespace {

using Fingerprint = std::array<std::uint64_t, 2>;

// Fingerprint of a set of items, in whatever order they are added: sums of powers of their hashes.
struct ItemSum {
  std::uint64_t hashes = 0, squares = 0;

  void add(std::uint64_t item) {
    const std::uint64_t h = mix_bits(item);
    hashes += h;
    squares += h * h;
  }
  void add(const ItemSum& s) {
    hashes += s.hashes;
    squares += s.squares;
  }
};

// What is at a place of a block, and the clearances there.
std::uint64_t item(std::uint64_t what, std::size_t place, float clearance, float next = 0) {
  const std::uint64_t clearances = std::uint64_t{std::bit_cast<std::uint32_t>(next)} << 32 |
                                   std::bit_cast<std::uint32_t>(clearance);
  return clearances ^ (what << 60 | std::uint64_t{place}) * 0x9e3779b97f4a7c15u;
}

// For each candidate of a block, all that its stone takes from there: its voxels, and its faces
// with what lies across.
std::vector<ItemSum> parts_of(const BlockTable& table, std::size_t b) {
  constexpr std::uint64_t kOne = 0, kTwo = 1, kFace = 2;
  const Block& block = table.blocks()[b];
  std::vector<ItemSum> parts(block.candidates.size());
  std::size_t i = 0;
  block.for_each_run([&](const Int3&, int count, std::uint32_t owner) {
    const auto length = static_cast<std::size_t>(count);
    ItemSum sum;
    const float* const clearance = &block.clearance[i];
    std::size_t x = 0;
    for (; x + 1 < length; x += 2) sum.add(item(kTwo, i + x, clearance[x], clearance[x + 1]));
    if (x < length) sum.add(item(kOne, i + x, clearance[x]));
    parts[owner].add(sum);
    i += length;
  });

  BlockFaces faces(block, table.places()[b].type, table.adjacent(table.places()[b]),
                   table.layout());
  std::vector<std::uint64_t> names;
  for (const Party& party : faces.parties()) {
    const Int3& cell = party.cell;
    names.push_back(extend(extend(extend(extend(0, party.seed), cell.x), cell.y), cell.z));
  }
  faces.for_each([&](const Face& face) {
    // Middles are different for all faces.
    const glm::i64vec3 middle(face.middle() - 2 * block.min + 1), size(2 * (block.size + 1));
    const auto place = static_cast<std::size_t>(middle.x + size.x * (middle.y + size.y * middle.z));
    const auto add = [&](std::uint32_t own, std::uint32_t other, std::uint32_t runner_up,
                         float clearance) {
      if (own >= parts.size()) return;
      const bool next = own == runner_up;
      parts[own].add(item(kFace + next, place, clearance) + face.shared * names[other]);
    };
    add(face.lower, face.upper, face.upper_runner_up, face.upper_clearance);
    add(face.upper, face.lower, face.lower_runner_up, face.lower_clearance);
  });
  return parts;
}

}  // namespace

std::vector<std::uint32_t> find_equal_stones(const BlockTable& blocks,
                                             std::span<const StoneKey> stones) {
  std::vector<std::vector<ItemSum>> parts(blocks.blocks().size());
  parallel_for(parts.size(), [&](std::size_t b) { parts[b] = parts_of(blocks, b); });

  std::vector<Fingerprint> fingerprints(stones.size());
  tbb::enumerable_thread_specific<StoneGrid> grids;
  constexpr std::size_t kGrain = 64;
  parallel_for(
      stones.size(),
      [&](std::size_t i) {
        StoneGrid& grid = grids.local();
        grid.find_pieces(blocks, stones[i]);
        Fingerprint sum{};
        const auto add = [&](std::uint64_t hashes, std::uint64_t squares) {
          sum[0] = extend(sum[0], static_cast<std::int64_t>(hashes));
          sum[1] = extend(sum[1], static_cast<std::int64_t>(squares));
        };
        add(blocks.layout().cell_index(stones[i].cell), 0);
        for (const StoneGrid::Piece& piece : grid.pieces()) {
          if (!piece.self) continue;
          // Seeds are told apart by where they are kept.
          const Seed* const seed = piece.block->candidates[*piece.self].form;
          const ItemSum& part = parts[blocks.index_of(*piece.block)][*piece.self];
          add(part.hashes + reinterpret_cast<std::uintptr_t>(seed), part.squares);
        }
        fingerprints[i] = sum;
      },
      kGrain);

  std::vector<std::uint32_t> order(stones.size()), first(stones.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(fingerprints[a], a) < std::tie(fingerprints[b], b);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    const bool is_new = k == 0 || fingerprints[order[k - 1]] != fingerprints[i];
    first[i] = is_new ? i : first[order[k - 1]];
  }
  return first;
}

}  // namespace talus::rocks
