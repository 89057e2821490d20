#include "talus/rocks/equal_stones.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>
#include <tuple>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"

namespace talus::rocks {
namespace {

using Fingerprint = std::array<std::uint64_t, 2>;

// What a fingerprint is taken of.
class Content {
 public:
  void clear() { size_ = 0; }
  void add(const float* values, int count) {
    std::uint32_t* const to = more(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) to[k] = std::bit_cast<std::uint32_t>(values[k]);
  }
  template <class T>
  requires(sizeof(T) % sizeof(std::uint32_t) == 0) void add(const T& value) {
    std::memcpy(more(sizeof value / sizeof(std::uint32_t)), &value, sizeof value);
  }
  Fingerprint fingerprint() const {
    Digest digest;
    digest.add(std::span(words_).first(size_));
    return digest.words();
  }

 private:
  std::uint32_t* more(std::size_t count) {
    size_ += count;
    if (size_ > words_.size()) words_.resize(2 * size_);
    return &words_[size_ - count];
  }

  std::vector<std::uint32_t> words_;
  std::size_t size_ = 0;  // of `words_` in use
};

// What a block holds of one of its candidates. Seeds are told apart by where they are kept.
Fingerprint part_of(const Block& block, std::size_t candidate, Content& content) {
  content.clear();
  content.add(block.candidates[candidate].form);
  for (const VoxelRun& run : block.runs_of(candidate)) {
    content.add(run.first);
    content.add(run.length);
    content.add(&block.clearance[block.index(run.first)], run.length);
  }
  for (const Patch& patch : block.patches.of(candidate)) {
    content.add(patch.cell);
    content.add(std::uint32_t{patch.seed} << 1 | std::uint32_t{patch.known_to_both});
    for (const FaceRun& faces : block.patches.runs_of(patch)) content.add(faces);
    content.add(&block.patches.distance_beyond[patch.first_face], static_cast<int>(patch.faces));
  }
  return content.fingerprint();
}

std::vector<std::vector<Fingerprint>> parts_of(std::span<const Block> blocks) {
  std::vector<std::vector<Fingerprint>> parts(blocks.size());
  parallel_for(blocks.size(), [&](std::size_t b) {
    const Block& block = blocks[b];
    Content content;
    parts[b].resize(block.candidates.size());
    for (std::size_t c = 0; c < parts[b].size(); ++c)
      if (!block.extent[c].empty()) parts[b][c] = part_of(block, c, content);
  });
  return parts;
}

}  // namespace

std::vector<std::uint32_t> find_equal_stones(const BlockTable& blocks,
                                             std::span<const StoneKey> stones) {
  const std::vector<std::vector<Fingerprint>> parts = parts_of(blocks.blocks());
  std::vector<Fingerprint> fingerprints(stones.size());
  struct Scratch {
    StoneGrid grid;
    Content content;
  };
  tbb::enumerable_thread_specific<Scratch> scratch;
  constexpr std::size_t kGrain = 64;
  parallel_for(
      stones.size(),
      [&](std::size_t i) {
        auto& [grid, content] = scratch.local();
        grid.find_pieces(blocks, stones[i]);
        content.clear();
        content.add(stones[i].cell);
        for (std::size_t k = 0; k < grid.pieces().size(); ++k) {
          const StoneGrid::Piece& piece = grid.pieces()[k];
          if (!piece.self || piece.block->extent[*piece.self].empty()) continue;
          const auto block = static_cast<std::size_t>(piece.block - blocks.blocks().data());
          content.add(k);
          content.add(parts[block][*piece.self]);
        }
        fingerprints[i] = content.fingerprint();
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
