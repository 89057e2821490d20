#include "talus/terrain/layer_support.h"

#include <fmt/format.h>

#include <string>

namespace talus {
namespace {

constexpr int kBlock = 16;  // columns along the edge of a block that is summed up

std::string names(const MaterialSet& materials) {
  std::string names;
  for (int m = 0; m < kMaterialCount; ++m)
    if (const auto material = static_cast<Material>(m); materials.contains(material))
      names += fmt::format("{}{}", names.empty() ? "" : ", ", material_info(material).name);
  return names.empty() ? "no material" : names;
}

}  // namespace

LayerSupport::LayerSupport(LayeredTerrain terrain, const MaterialSet& materials)
    : terrain_(std::move(terrain)), materials_(materials) {
  blocks_.resize(block_of(terrain_.grid().nx - 1, terrain_.grid().ny - 1) + 1);
  summarize();
  if (bounds_.empty())
    throw usage_error(fmt::format(
        "the terrain has no layer of {} to fill; lay some first, or choose other materials",
        names(materials)));
}

// Index of the block that holds a column.
std::size_t LayerSupport::block_of(int x, int y) const {
  const int along_x = (terrain_.grid().nx - 1) / kBlock + 1;
  return static_cast<std::size_t>(y / kBlock * along_x + x / kBlock);
}

void LayerSupport::summarize() {
  const TerrainGrid& grid = terrain_.grid();
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x) {
      Span inside;
      Steps bottom = grid.floor;
      for (const Layer& layer : terrain_.column(x, y)) {
        if (materials_.contains(layer.material())) inside.include({bottom, layer.top()});
        bottom = layer.top();
      }
      if (inside.begin >= inside.end) continue;
      blocks_[block_of(x, y)].include(inside);
      bounds_.include({grid.origin_x + x * grid.cell, grid.origin_y + y * grid.cell,
                       terrain_.height_of(inside.begin)});
      bounds_.include({grid.origin_x + (x + 1) * grid.cell, grid.origin_y + (y + 1) * grid.cell,
                       terrain_.height_of(inside.end)});
    }
}

bool LayerSupport::contains(const Vec3& p) const { return classify({p, p}) == BoxState::inside; }

BoxState LayerSupport::Range::state() const {
  if (any_inside) return any_outside ? BoxState::mixed : BoxState::inside;
  return BoxState::outside;
}

LayerSupport::Range LayerSupport::range(double bottom, double top) const {
  return {terrain_.grid().step_at(bottom), terrain_.grid().step_at(top)};
}

void LayerSupport::look_into_column(int x, int y, std::span<Range> ranges) const {
  const std::span<const Layer> column = terrain_.column(x, y);
  for (Range& range : ranges) {
    range.any_outside |= range.begin < terrain_.grid().floor;
    Steps bottom = terrain_.grid().floor;
    for (const Layer& layer : column) {
      if (bottom <= range.last && layer.top() > range.begin)
        (materials_.contains(layer.material()) ? range.any_inside : range.any_outside) = true;
      bottom = layer.top();
    }
    range.any_outside |= range.last >= bottom;
  }
}

// Those that a closed rectangle of the plan meets, on the terrain and beyond.
ColumnArea LayerSupport::columns_of(const Box2& plan) const {
  const TerrainGrid& grid = terrain_.grid();
  return {grid.column_x(plan.min.x), grid.column_y(plan.min.y), grid.column_x(plan.max.x) + 1,
          grid.column_y(plan.max.y) + 1};
}

// States of boxes one above the other, at bits 0, 16, 32, 48.
BlockStates LayerSupport::look_up(const ColumnArea& columns, std::array<Range, 4> ranges) const {
  look(columns, ranges);
  BlockStates states;
  for (std::size_t z = 0; z < 4; ++z) {
    const BoxState state = ranges[z].state();
    states.inside |= std::uint64_t{state == BoxState::inside} << (16 * z);
    states.outside |= std::uint64_t{state == BoxState::outside} << (16 * z);
  }
  return states;
}

// What the ranges meet in the columns.
void LayerSupport::look(const ColumnArea& columns, std::span<Range> ranges) const {
  const TerrainGrid& grid = terrain_.grid();
  const ColumnArea area = intersection(columns, {0, 0, grid.nx, grid.ny});
  const bool reaches_out = !(area == columns);
  Span all;
  for (Range& range : ranges) {
    range.any_outside = reaches_out;
    all.include({range.begin, range.last});
  }
  for (int by = area.y_begin / kBlock * kBlock; by < area.y_end; by += kBlock)
    for (int bx = area.x_begin / kBlock * kBlock; bx < area.x_end; bx += kBlock) {
      const Span& span = blocks_[block_of(bx, by)];
      if (span.begin > all.end || span.end <= all.begin) {
        for (Range& range : ranges) range.any_outside = true;
        continue;
      }
      const ColumnArea part = intersection(area, {bx, by, bx + kBlock, by + kBlock});
      for (int y = part.y_begin; y < part.y_end; ++y)
        for (int x = part.x_begin; x < part.x_end; ++x) {
          look_into_column(x, y, ranges);
          if (std::ranges::all_of(ranges,
                                  [](const Range& r) { return r.any_inside && r.any_outside; }))
            return;
        }
    }
}

BoxState LayerSupport::classify(const Box3& box) const {
  Range range = this->range(box.min.z, box.max.z);
  look(columns_of({Vec2(box.min), Vec2(box.max)}), {&range, 1});
  return range.state();
}

std::uint64_t LayerSupport::contains_block(const PointBlock& block) const {
  return classify_block(block, Vec3(0)).inside;
}

BlockStates LayerSupport::classify_block(const PointBlock& centers, const Vec3& half) const {
  if (!centers.is_upright()) return Support::classify_block(centers, half);
  std::array<Range, 4> heights;
  for (int z = 0; z < 4; ++z) {
    const double height = centers.point(16 * z).z;
    heights[static_cast<std::size_t>(z)] = range(height - half.z, height + half.z);
  }
  // Boxes that meet the same columns are alike.
  BlockStates states, above;
  ColumnArea columns{};
  for (int i = 0; i < 16; ++i) {
    const Vec2 middle(centers.point(i));
    const ColumnArea met = columns_of({middle - Vec2(half), middle + Vec2(half)});
    if (i == 0 || !(met == columns)) above = look_up(met, heights);
    columns = met;
    states.inside |= above.inside << i;
    states.outside |= above.outside << i;
  }
  return states;
}

}  // namespace talus
