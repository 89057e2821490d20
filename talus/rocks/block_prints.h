// What tells the stones of a block apart.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/hash.h"
#include "talus/base/lanes.h"
#include "talus/rocks/block_faces.h"

namespace talus::rocks {

// Fingerprints of all that stones take from a block: their voxels, and their faces with what lies
// across. Sums of hashes, for faces also of their squares, in whatever order they are added.
class BlockPrints {
 public:
  // Adds the voxels.
  BlockPrints(const Block& block, std::span<const Party> parties);

  void add(const Face& face) {
    // Middles are different for all faces.
    const glm::i64vec3 middle(face.middle() - 2 * block_.min + 1), size(2 * (block_.size + 1));
    const auto place =
        static_cast<std::uint64_t>(middle.x + size.x * (middle.y + size.y * middle.z));
    const auto add_to = [&](std::uint32_t own, std::uint32_t other, std::uint32_t runner_up,
                            float clearance) {
      if (own >= sums_.size()) return;
      const std::uint64_t what =
          place * 2 + (own == runner_up) + (face.shared ? names_[other] : std::uint64_t{0});
      const std::uint64_t h =
          mix_bits(what * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint32_t>(clearance));
      sums_[own].faces += h;
      sums_[own].squares += h * h;
    };
    add_to(face.lower, face.upper, face.upper_runner_up, face.upper_clearance);
    add_to(face.upper, face.lower, face.lower_runner_up, face.lower_clearance);
  }

  // By candidate of the block.
  std::vector<StonePrint> prints() const;

 private:
  // Sums of 32 bits each over a stone's voxels, by two hashes.
  struct Sums {
    Words first{}, second{};
    std::uint64_t faces = 0, squares = 0;
  };
  void add_voxels();

  const Block& block_;
  std::vector<Sums> sums_;            // by candidate
  std::vector<std::uint64_t> names_;  // by party
};

}  // namespace talus::rocks
