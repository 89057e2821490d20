// Disjoint sets of numbered items.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace talus {

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  // The item that stands for the set of item i.
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // Whether they were apart.
  bool join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = root(a), to = root(b);
    parent_[from] = to;
    return from != to;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace talus
