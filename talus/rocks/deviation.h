// How far tiles can be from the diagram that they stand for.
#pragma once

#include <optional>

#include "talus/rocks/blocks.h"

namespace talus::rocks {

// What a set of tiles should not exceed, as a share of space.
inline constexpr double kMuchDeviation = 0.05;

// The share of space, on average over all tilings, where a seed beyond those that compete could be
// nearer than the owner's: the seeds of every coloring are tried, whatever the tiling turns out to
// be. Where tilings end their windows a stone may differ from its cell of the unrestricted diagram.
// Parallel. Throws `Cancelled`.
double deviation_bound(const BlockTable& table, Job* job = nullptr);

// The least n above that of `params` that keeps the bound, measured on coarse tiles, below
// `kMuchDeviation`; nothing if none up to 9 does.
std::optional<int> find_sufficient_n(const TileParams& params, std::uint64_t seed, Job* job);

}  // namespace talus::rocks
