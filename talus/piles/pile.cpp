#include "talus/piles/pile.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "talus/base/parallel.h"
#include "talus/piles/choice.h"

namespace talus {
namespace {

using piles::Lattice;

constexpr double kMaxCells = 50e6;

// The cells of a lattice whose stones can reach into a support.
struct CellBox {
  Int3 first;
  Int3 size;

  std::size_t index(const Int3& cell) const {
    const Int3 at = cell - first;
    return static_cast<std::size_t>(at.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(at.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(at.z));
  }
  bool contains(const Int3& cell) const {
    for (int axis = 0; axis < 3; ++axis)
      if (cell[axis] < first[axis] || cell[axis] >= first[axis] + size[axis]) return false;
    return true;
  }
};

double cell_count(const Box3& bounds, double cell_size, double reach) {
  const Vec3 cells = glm::ceil(bounds.size() / cell_size + 2 * reach);
  return cells.x * cells.y * cells.z;
}

CellBox cells_around(const Box3& bounds, double cell_size, double reach) {
  const double count = cell_count(bounds, cell_size, reach);
  if (!(count <= kMaxCells)) {
    const Vec3 s = bounds.size();
    const double least = std::cbrt(s.x * s.y * s.z / kMaxCells);
    throw usage_error(
        fmt::format("stone_size = {:.3g} m asks for about {:.2g} cells; at most {:.0g} are "
                    "possible, so give at "
                    "least about {:.3g} m",
                    cell_size, count, kMaxCells, std::max(least, bounds.longest_side() / 2000)));
  }
  const int margin = static_cast<int>(std::ceil(reach));
  return {Int3(-margin), Int3(glm::ceil(bounds.size() / cell_size)) + 2 * margin};
}

// Mean radius of the balls around the tile set's stones, in cells.
double mean_radius(const TileSet& tiles) {
  double sum = 0;
  std::size_t count = 0;
  for (const Stone& stone : tiles.stones())
    if (stone.mesh) {
      sum += stone.radius;
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// One stone that lies in the support.
struct Chosen {
  PlacedStone placed;
  bool hidden;
  std::size_t contacts = 0;  // with other chosen stones
};

// Works out which stones of the tiling over `cells` belong to a pile.
class Chooser {
 public:
  Chooser(const Support& support, const TileSet& tiles, const PileParams& params,
          const Lattice& lattice, const CellBox& cells)
      : support_(support), tiles_(tiles), params_(params), lattice_(lattice), cells_(cells) {
    hidden_depth_ = params.surface_depth * mean_radius(tiles) * lattice.cell_size;
  }

  // Stones of every layer of cells, sorted by y, x, seed.
  std::vector<std::vector<Chosen>> choose(Job* job) const {
    std::vector<std::vector<Chosen>> layers(static_cast<std::size_t>(cells_.size.z));
    parallel_for(layers.size(), [&](std::size_t layer) {
      check_cancelled(job);
      const int z = cells_.first.z + static_cast<int>(layer);
      for (int y = cells_.first.y; y < cells_.first.y + cells_.size.y; ++y)
        for (int x = cells_.first.x; x < cells_.first.x + cells_.size.x; ++x)
          choose_in_cell({x, y, z}, layers[layer]);
    });
    return layers;
  }

 private:
  void choose_in_cell(const Int3& cell, std::vector<Chosen>& out) const {
    const Box3 reach{lattice_.world(cell, Vec3(-tiles_.reach())),
                     lattice_.world(cell, Vec3(1 + tiles_.reach()))};
    const BoxState state = support_.classify(reach);
    if (state == BoxState::outside) return;

    const TileSet::Run run = tiles_.stones_at(cell);
    const double voxel_size = static_cast<double>(tiles_.params().n) / tiles_.params().voxels();
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const Stone& stone = tiles_.stones()[i];
      if (!stone.mesh) continue;
      if (state == BoxState::inside ||
          lies_inside(support_, stone, voxel_size, lattice_, cell, params_.inside_fraction))
        out.push_back(
            {.placed = {cell, i}, .hidden = params_.surface_only && is_hidden(stone, cell)});
    }
  }

  bool is_hidden(const Stone& stone, const Int3& cell) const {
    const Vec3 pivot = lattice_.world(cell, stone.pivot);
    return support_.classify({pivot - hidden_depth_, pivot + hidden_depth_}) == BoxState::inside;
  }

  const Support& support_;
  const TileSet& tiles_;
  const PileParams& params_;
  Lattice lattice_;
  CellBox cells_;
  double hidden_depth_ = 0;
};

// The chosen stones by cell, to find a stone's neighbors.
class ChosenGrid {
 public:
  ChosenGrid(const TileSet& tiles, const CellBox& cells, const std::vector<Chosen>& chosen)
      : tiles_(tiles), cells_(cells), chosen_(chosen) {
    first_.assign(cells.index(cells.first + Int3(0, 0, cells.size.z)) + 1, 0);
    for (const Chosen& c : chosen) ++first_[cells.index(c.placed.cell) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  }

  // Contacts of chosen stone i that both stones keep and whose other stone is chosen too.
  std::size_t contacts(std::size_t i) const {
    const Chosen& own = chosen_[i];
    const Stone& stone = tiles_.stones()[own.placed.stone];
    std::size_t count = 0;
    for (const StoneContact& contact : stone.contacts) {
      const Int3 cell = own.placed.cell + contact.cell;
      if (!contact.kept || !cells_.contains(cell)) continue;
      const std::size_t c = cells_.index(cell);
      for (std::size_t k = first_[c]; k < first_[c + 1]; ++k) {
        const Stone& other = tiles_.stones()[chosen_[k].placed.stone];
        if (other.seed == contact.seed) count += keeps(other, -contact.cell, stone.seed);
      }
    }
    return count;
  }

 private:
  static bool keeps(const Stone& stone, const Int3& cell, std::uint16_t seed) {
    for (const StoneContact& contact : stone.contacts)
      if (contact.cell == cell && contact.seed == seed) return contact.kept;
    return false;
  }

  const TileSet& tiles_;
  CellBox cells_;
  const std::vector<Chosen>& chosen_;
  std::vector<std::size_t> first_;
};

// The stones that lie in the support, but for those that would touch no other, which are counted.
struct Choice {
  std::vector<Chosen> stones;
  std::uint64_t isolated = 0;
};

Choice choose_stones(const Support& support, const TileSet& tiles, const PileParams& params,
                     const Lattice& lattice, Job* job) {
  const CellBox cells = cells_around(support.bounds(), lattice.cell_size, tiles.reach());
  std::vector<Chosen> inside;
  for (const auto& layer : Chooser(support, tiles, params, lattice, cells).choose(job))
    inside.insert(inside.end(), layer.begin(), layer.end());

  const ChosenGrid grid(tiles, cells, inside);
  parallel_for(
      inside.size(), [&](std::size_t i) { inside[i].contacts = grid.contacts(i); }, 256);
  Choice choice;
  for (const Chosen& stone : inside) {
    if (stone.contacts > 0 || inside.size() == 1)
      choice.stones.push_back(stone);
    else
      ++choice.isolated;
  }
  return choice;
}

// Tries smaller and smaller stones, as long as that is quick, to say what would fit.
[[noreturn]] void refuse_stone_size(const Support& support, const TileSet& tiles,
                                    const PileParams& params, double asked, Job* job) {
  constexpr double kShrink = 0.9, kQuickCells = 1e5;
  const Box3 bounds = support.bounds();
  const double longest = bounds.longest_side();
  double size = std::min(asked, longest);
  for (; cell_count(bounds, size, tiles.reach()) < kQuickCells; size *= kShrink) {
    if (choose_stones(support, tiles, params, {bounds.min, size}, job).stones.empty()) continue;
    throw usage_error(fmt::format(
        "stone_size = {:.4g} m is too large: no stone fits into a support whose longest side is "
        "{:.4g} m; the largest size that fits is about {:.3g} m ({:.2g}%)",
        asked, longest, size, 100 * size / longest));
  }
  throw usage_error(fmt::format(
      "stone_size = {:.4g} m is too large: the support is so thin that no stone fits, of "
      "any size down to {:.3g} m; give a thicker support or a smaller stone_size",
      asked, size / kShrink));
}

}  // namespace

Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles, const PileParams& params,
          Job* job) {
  validate(params, "pile");
  report_progress(job, "pile", 0);
  Pile pile;
  pile.tiles = std::move(tiles);
  pile.origin = support.bounds().min;
  pile.cell_size = params.stone_size.in_metres(support.bounds().longest_side());

  const Lattice lattice{pile.origin, pile.cell_size};
  const Choice choice = choose_stones(support, *pile.tiles, params, lattice, job);
  // Smaller stones would not touch either.
  if (choice.stones.empty() && choice.isolated > 0 && pile.tiles->stats().contacts_mean < 1)
    throw usage_error(
        fmt::format("none of the {} stones that fit keeps a contact with another; lower "
                    "contacts.discard_fraction or weathering.depth",
                    choice.isolated));
  if (choice.stones.empty()) refuse_stone_size(support, *pile.tiles, params, pile.cell_size, job);
  report_progress(job, "pile", 0.9);

  pile.stats.isolated = choice.isolated;
  std::vector<bool> used(pile.tiles->stones().size());
  std::size_t contacts = 0;
  for (const Chosen& stone : choice.stones) {
    if (stone.hidden) {
      ++pile.stats.hidden;
      continue;
    }
    pile.stones.push_back(stone.placed);
    contacts += stone.contacts;
    used[stone.placed.stone] = true;
  }
  pile.stats.instances = pile.stones.size();
  pile.stats.unique = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));
  if (!pile.stones.empty())
    pile.stats.contacts_mean =
        static_cast<double>(contacts) / static_cast<double>(pile.stones.size());
  report_progress(job, "pile", 1);
  return pile;
}

InstanceTable instances(const Pile& pile) {
  // Prototypes in the tile set's order; stones that share a mesh share the prototype.
  const std::span<const Stone> stones = pile.tiles->stones();
  std::vector<bool> used(stones.size());
  for (const PlacedStone& placed : pile.stones) used[placed.stone] = true;
  InstanceTable table;
  std::vector<std::uint32_t> prototype(stones.size());
  std::unordered_map<const TriangleMesh*, std::uint32_t> known;  // only looked up, never iterated
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (!used[i]) continue;
    const auto next = static_cast<std::uint32_t>(table.prototypes.size());
    const auto [entry, is_new] = known.try_emplace(stones[i].mesh.get(), next);
    if (is_new) table.prototypes.push_back(stones[i].mesh);
    prototype[i] = entry->second;
  }

  const Lattice lattice{pile.origin, pile.cell_size};
  for (const PlacedStone& placed : pile.stones)
    table.instances.push_back({.position = lattice.world(placed.cell, stones[placed.stone].pivot),
                               .scale = static_cast<float>(pile.cell_size),
                               .prototype = prototype[placed.stone]});
  std::stable_sort(table.instances.begin(), table.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; });
  return table;
}

}  // namespace talus
