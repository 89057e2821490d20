// Choosing among the cells of one class those that leave larger ones alone.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "talus/scatter/cell.h"

namespace talus::scatter {

// A site and the hash of its place, which orders those of a block and stays with its stone.
struct Candidate {
  std::size_t site = 0;
  std::uint64_t key = 0;
};

// Cells of one class, found by place.
struct ChosenCells {
  SiteSet sites;
  std::vector<Cell> cells;          // in the order of `sites`
  std::vector<std::uint64_t> keys;  // likewise
};

// When a class has enough in a block: by area, met within half a cell, and by number.
struct Goal {
  std::int64_t twice_area = std::numeric_limits<std::int64_t>::max();
  std::size_t count = std::numeric_limits<std::size_t>::max();
};

// Whether a cell that meets a larger one is passed over, or cut along that one's edges, if what is
// left is still stone-like: not too small beside whole cells, nor too long.
enum class Fit { whole, cut };

// What a block has of a class, in the order of the keys.
struct Choice {
  std::vector<Cell> cells;
  std::vector<std::uint64_t> keys;
  std::int64_t twice_area = 0;
  std::size_t candidates = 0;
  bool exhausted = false;  // no other candidate fits
};

// Takes the cells of candidates in the order of their keys, but those that do not fit beside the
// cells in `larger`, until the goal is met ([Sakurai2010] section 3.2).
Choice choose_cells(const SiteSet& sites, const std::optional<Rect>& bounds,
                    std::vector<Candidate> candidates, const std::vector<ChosenCells>& larger,
                    Fit fit, const Goal& goal);

}  // namespace talus::scatter
