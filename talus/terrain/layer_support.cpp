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

BoxState LayerSupport::classify(const Box3& box) const {
  const TerrainGrid& grid = terrain_.grid();
  const int x_begin = grid.column_x(box.min.x), x_last = grid.column_x(box.max.x);
  const int y_begin = grid.column_y(box.min.y), y_last = grid.column_y(box.max.y);
  const Steps z_begin = grid.step_at(box.min.z), z_last = grid.step_at(box.max.z);

  bool any_inside = false;
  bool any_outside = x_begin < 0 || x_last >= grid.nx || y_begin < 0 || y_last >= grid.ny;
  const ColumnArea area =
      intersection({x_begin, y_begin, x_last + 1, y_last + 1}, {0, 0, grid.nx, grid.ny});
  for (int by = area.y_begin / kBlock * kBlock; by < area.y_end; by += kBlock)
    for (int bx = area.x_begin / kBlock * kBlock; bx < area.x_end; bx += kBlock) {
      const Span& span = blocks_[block_of(bx, by)];
      if (span.begin > z_last || span.end <= z_begin) {
        any_outside = true;
        continue;
      }
      const ColumnArea part = intersection(area, {bx, by, bx + kBlock, by + kBlock});
      for (int y = part.y_begin; y < part.y_end; ++y)
        for (int x = part.x_begin; x < part.x_end; ++x) {
          // Which kinds of layers the steps from `z_begin` to `z_last` meet.
          any_outside |= z_begin < grid.floor;
          Steps bottom = grid.floor;
          for (const Layer& layer : terrain_.column(x, y)) {
            if (bottom <= z_last && layer.top() > z_begin)
              (materials_.contains(layer.material()) ? any_inside : any_outside) = true;
            bottom = layer.top();
          }
          any_outside |= z_last >= bottom;
          if (any_inside && any_outside) return BoxState::mixed;
        }
    }
  if (any_inside) return any_outside ? BoxState::mixed : BoxState::inside;
  return BoxState::outside;
}

}  // namespace talus
