#include "talus/io/instance_cells.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace talus {
namespace {

constexpr std::size_t kCellInstances = 4096;
constexpr std::size_t kRunInstances = 64;

class CellSplitter {
 public:
  explicit CellSplitter(const InstanceTable& table)
      : table_(table), seen_in_(table.prototypes.size(), 0), order_(table.instances.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  InstanceCells split() {
    if (!order_.empty()) split(order_);
    return {std::move(order_), std::move(cells_)};
  }

 private:
  void split(std::span<std::uint32_t> part) {
    const Box3 box = box_of(part);
    const std::size_t half = part.size() / 2;
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (half >= kCellInstances) {
      std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                       [&](std::uint32_t a, std::uint32_t b) {
                         return std::pair(position(a)[axis], a) < std::pair(position(b)[axis], b);
                       });
      const auto low = part.first(half), high = part.subspan(half);
      if (is_worth_a_cell(low) && is_worth_a_cell(high)) {
        split(low);
        split(high);
        return;
      }
    }
    std::sort(part.begin(), part.end());
    add_cell(part, box);
  }

  void add_cell(std::span<const std::uint32_t> part, const Box3& box) {
    InstanceCell& cell = cells_.emplace_back(InstanceCell{.positions = box});
    auto first = static_cast<std::size_t>(part.data() - order_.data());
    for (const std::uint32_t i : part) {
      const std::uint32_t prototype = table_.instances[i].prototype;
      if (cell.runs.empty() || cell.runs.back().prototype != prototype)
        cell.runs.push_back({.prototype = prototype, .first = first});
      ++cell.runs.back().count;
      ++first;
    }
  }

  // Whether its runs are long enough on average.
  bool is_worth_a_cell(std::span<const std::uint32_t> part) {
    ++marks_;
    std::size_t prototypes = 0;
    for (const std::uint32_t i : part)
      prototypes += std::exchange(seen_in_[table_.instances[i].prototype], marks_) != marks_;
    return part.size() >= kRunInstances * prototypes;
  }

  Box3 box_of(std::span<const std::uint32_t> part) const {
    Box3 box;
    for (const std::uint32_t i : part) box.include(position(i));
    return box;
  }

  const Vec3& position(std::uint32_t i) const { return table_.instances[i].position; }

  const InstanceTable& table_;
  std::vector<std::uint32_t> seen_in_;  // for each prototype the last part that showed it
  std::uint32_t marks_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<InstanceCell> cells_;
};

}  // namespace

InstanceCells split_into_cells(const InstanceTable& table) { return CellSplitter(table).split(); }

}  // namespace talus
