#include "talus/terrain/water_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>

#include "talus/base/parallel.h"
#include "talus/terrain/terrain_field.h"

namespace talus {
namespace {

// A square or a corner of a row, by its place along x and its height.
struct Place {
  int x;
  Steps level;
  auto operator<=>(const Place&) const = default;
};
using Row = std::vector<Place>;

void sort_unique(Row& row) {
  std::sort(row.begin(), row.end());
  row.erase(std::unique(row.begin(), row.end()), row.end());
}

// Tops of water with air above.
Row open_water(const LayeredTerrain& terrain, int y) {
  Row row;
  for (int x = 0; x < terrain.grid().nx; ++x) {
    const std::span<const Layer> layers = terrain.column(x, y);
    for (std::size_t i = 0; i < layers.size(); ++i)
      if (layers[i].material() == Material::water &&
          (i + 1 == layers.size() || layers[i + 1].material() == Material::air))
        row.push_back({x, layers[i].top()});
  }
  return row;
}

// Columns side by side in a row, from x = begin to end - 1.
struct Strip {
  Steps level;
  int begin, end;
  auto operator<=>(const Strip&) const = default;
};
using Strips = std::vector<Strip>;

// Sorts strips and makes one of those that overlap or touch.
void join(Strips& strips) {
  std::sort(strips.begin(), strips.end());
  std::size_t count = 0;
  for (const Strip& strip : strips)
    if (count > 0 && strips[count - 1].level == strip.level && strip.begin <= strips[count - 1].end)
      strips[count - 1].end = std::max(strips[count - 1].end, strip.end);
    else
      strips[count++] = strip;
  strips.resize(count);
}

// The places up to `reach` columns west and east of those of a row.
Strips widened(const Row& row, int reach, int nx) {
  Strips wide;
  for (const Place& water : row)
    wide.push_back({water.level, std::max(water.x - reach, 0), std::min(water.x + reach + 1, nx)});
  join(wide);
  return wide;
}

// Whether water may go on there as under a bank: neither in air nor in other water.
bool is_bank(Material material) { return material != Material::air && material != Material::water; }

// A row's own water, and what the water around needs under its banks.
Row squares(const LayeredTerrain& terrain, std::span<const Strips> wide, int reach, int y) {
  Strips near;
  for (int from = std::max(y - reach, 0); from <= std::min(y + reach, terrain.grid().ny - 1);
       ++from) {
    const Strips& strips = wide[static_cast<std::size_t>(from)];
    near.insert(near.end(), strips.begin(), strips.end());
  }
  join(near);
  Row row = open_water(terrain, y);
  for (const Strip& strip : near)
    for (int x = strip.begin; x < strip.end; ++x)
      if (is_bank(terrain.material(x, y, strip.level - 1))) row.push_back({x, strip.level});
  sort_unique(row);
  return row;
}

}  // namespace

TriangleMesh make_water_surface(const LayeredTerrain& terrain, const Vec3& origin,
                                const WaterSurfaceParams& params, Job* job) {
  validate(params, "water");
  const TerrainGrid& grid = terrain.grid();
  const double bank = params.bank.value_or(grid.cell);
  const double widest = TerrainField::kSigmaColumnsMax * grid.cell;
  if (bank > widest)
    throw usage_error(
        fmt::format("bank = {} m is out of range; it must be at most {} m, {} columns", bank,
                    widest, TerrainField::kSigmaColumnsMax));
  const auto ny = static_cast<std::size_t>(grid.ny);
  const int reach = static_cast<int>(std::ceil(bank / grid.cell));
  std::vector<Strips> wide(ny);
  std::vector<Row> squares_of(ny), corners(ny + 1);
  parallel_for(ny, [&](std::size_t y) {
    check_cancelled(job);
    wide[y] = widened(open_water(terrain, static_cast<int>(y)), reach, grid.nx);
  });
  parallel_for(ny, [&](std::size_t y) {
    check_cancelled(job);
    squares_of[y] = squares(terrain, wide, reach, static_cast<int>(y));
  });

  // Corners of the squares on either side of each line between rows.
  parallel_for(ny + 1, [&](std::size_t j) {
    for (std::size_t y = j == 0 ? 0 : j - 1; y < std::min(j + 1, ny); ++y)
      for (const Place& square : squares_of[y]) {
        corners[j].push_back(square);
        corners[j].push_back({square.x + 1, square.level});
      }
    sort_unique(corners[j]);
  });

  TriangleMesh mesh;
  std::vector<std::size_t> first(ny + 1);
  for (std::size_t j = 0; j <= ny; ++j) {
    first[j] = mesh.positions.size();
    for (const Place& corner : corners[j])
      mesh.positions.emplace_back(Vec3(grid.origin_x + corner.x * grid.cell,
                                       grid.origin_y + static_cast<double>(j) * grid.cell,
                                       terrain.height_of(corner.level)) -
                                  origin);
  }
  mesh.normals.assign(mesh.positions.size(), Vec3f(0, 0, 1));

  const auto vertex = [&](std::size_t j, const Place& corner) {
    const auto at = std::lower_bound(corners[j].begin(), corners[j].end(), corner);
    return static_cast<std::uint32_t>(first[j] + static_cast<std::size_t>(at - corners[j].begin()));
  };
  for (std::size_t y = 0; y < ny; ++y)
    for (const Place& square : squares_of[y]) {
      const Place east{square.x + 1, square.level};
      const std::uint32_t a = vertex(y, square), b = vertex(y, east);
      const std::uint32_t c = vertex(y + 1, east), d = vertex(y + 1, square);
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(a, c, d);
    }
  return mesh;
}

TriangleMesh make_water_surface(const LayeredTerrain& terrain, const Vec3& origin, Job* job) {
  return make_water_surface(terrain, origin, {}, job);
}

}  // namespace talus
