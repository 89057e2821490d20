#include "talus/terrain/layered_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "talus/base/parallel.h"

namespace talus {
namespace {

constexpr std::int64_t kColumnsMax = std::int64_t{1} << 30;
constexpr std::size_t kAllocationHeader = 8;  // of glibc's allocator
constexpr std::size_t kControlBlock = 16;     // of std::make_shared: a virtual table, two counts

void check_length(const char* name, double value) {
  if (!(value > 0 && std::isfinite(value)))
    throw usage_error(
        fmt::format("terrain.{} = {} m; it must be a positive, finite length", name, value));
}

void check_grid(const TerrainGrid& grid) {
  const std::int64_t columns = std::int64_t{grid.nx} * grid.ny;
  if (grid.nx < 1 || grid.ny < 1 || columns > kColumnsMax)
    throw usage_error(fmt::format(
        "a terrain of {} x {} columns is impossible; give at least 1 along each side and "
        "at most {} in all",
        grid.nx, grid.ny, kColumnsMax));
  check_length("cell", grid.cell);
  check_length("step", grid.step);
  if (!std::isfinite(grid.origin_x) || !std::isfinite(grid.origin_y))
    throw usage_error(
        fmt::format("the terrain's origin ({}, {}) must be finite", grid.origin_x, grid.origin_y));
  if (grid.floor < -kStepsMax || grid.floor > kStepsMax)
    throw usage_error(fmt::format("the terrain's floor at {} steps is out of range; give {} to {}",
                                  grid.floor, -kStepsMax, kStepsMax));
}

[[maybe_unused]] bool well_formed(std::span<const Layer> layers, Steps floor) {
  Steps below = floor;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].top() <= below || layers[i].top() > kStepsMax) return false;
    if (i > 0 && layers[i].material() == layers[i - 1].material()) return false;
    below = layers[i].top();
  }
  return layers.empty() || layers.back().material() != Material::air;
}

void add_volume(std::span<const Layer> layers, Steps floor, MaterialSteps& volume) {
  Steps bottom = floor;
  for (const Layer& layer : layers) {
    if (layer.material() != Material::air)
      volume[static_cast<std::size_t>(layer.material())] += layer.top() - bottom;
    bottom = layer.top();
  }
}

[[maybe_unused]] bool balanced(std::span<const Layer> before, std::span<const Layer> after,
                               Steps floor, std::span<const Conversion> conversions) {
  Booking booking;
  for (const Conversion& c : conversions) booking.convert(c);
  MaterialSteps volume = booking.change(), volume_after{};
  add_volume(before, floor, volume);
  add_volume(after, floor, volume_after);
  return volume == volume_after;
}

int tiles_along(int columns) {
  return (columns + LayeredTerrain::kTileColumns - 1) / LayeredTerrain::kTileColumns;
}

// Index of the interval that holds a coordinate, clamped to [low, high]; low for what is no number.
int interval_at(double coordinate, double size, int low, int high) {
  const double i = std::floor(coordinate / size);
  if (!(i > low)) return low;
  return i < high ? static_cast<int>(i) : high;
}

}  // namespace

int TerrainGrid::column_x(double x) const { return interval_at(x - origin_x, cell, -1, nx); }
int TerrainGrid::column_y(double y) const { return interval_at(y - origin_y, cell, -1, ny); }
Steps TerrainGrid::step_at(double z) const {
  return interval_at(z, step, -kStepsMax - 1, kStepsMax + 1);
}

ColumnArea TerrainGrid::columns_within(const Vec2& min, const Vec2& max) const {
  return intersection({column_x(min.x), column_y(min.y), column_x(max.x) + 1, column_y(max.y) + 1},
                      {0, 0, nx, ny});
}

ColumnArea intersection(const ColumnArea& a, const ColumnArea& b) {
  return {std::max(a.x_begin, b.x_begin), std::max(a.y_begin, b.y_begin),
          std::min(a.x_end, b.x_end), std::min(a.y_end, b.y_end)};
}

void stack(std::vector<Layer>& column, Steps floor, Material material, Steps top) {
  if (top <= (column.empty() ? floor : column.back().top())) return;
  const Layer layer(material, top);
  if (!column.empty() && column.back().material() == material)
    column.back() = layer;
  else
    column.push_back(layer);
}

void ColumnEditor::replace(Steps bottom, Steps top, Material material) {
  for (const Steps z : {bottom, top})
    if (z < -kStepsMax || z > kStepsMax)
      throw usage_error(fmt::format(
          "a height of {} steps is out of range, {} to {}; choose a larger vertical step", z,
          -kStepsMax, kStepsMax));
  bottom = std::max(bottom, floor_);
  if (top <= bottom) return;

  // Keep what is below the interval, over air if it begins above the column.
  scratch_.clear();
  for (const Layer& layer : layers_)
    stack(scratch_, floor_, layer.material(), std::min(layer.top(), bottom));
  stack(scratch_, floor_, Material::air, bottom);

  // Fill the interval and book what was in it.
  stack(scratch_, floor_, material, top);
  Steps begin = floor_;
  for (const Layer& layer : layers_) {
    const Steps overlap = std::min(layer.top(), top) - std::max(begin, bottom);
    if (overlap > 0) booking_.replace(layer.material(), material, overlap);
    begin = layer.top();
  }
  if (top > std::max(begin, bottom))
    booking_.replace(Material::air, material, top - std::max(begin, bottom));

  // Keep what is above it. Open air is no layer.
  for (const Layer& layer : layers_) stack(scratch_, floor_, layer.material(), layer.top());
  if (!scratch_.empty() && scratch_.back().material() == Material::air) scratch_.pop_back();
  layers_.swap(scratch_);
}

void ColumnEditor::rearrange(std::span<const Layer> layers,
                             std::span<const Conversion> conversions) {
  TALUS_ASSERT(well_formed(layers, floor_));
  TALUS_ASSERT(balanced(layers_, layers, floor_, conversions));
  for (const Conversion& c : conversions) booking_.convert(c);
  load(layers);
}

// The layers of up to 64 x 64 columns, one column after the other, row by row.
struct LayeredTerrain::Tile {
  std::vector<std::uint16_t> ends;       // one past the last layer of each column
  std::vector<std::uint32_t> wide_ends;  // instead of `ends` where those do not suffice
  std::vector<Layer> layers;

  Tile(std::span<const std::uint32_t> column_ends, std::span<const Layer> all)
      : layers(all.begin(), all.end()) {
    if (all.size() > std::numeric_limits<std::uint16_t>::max()) {
      wide_ends.assign(column_ends.begin(), column_ends.end());
    } else {
      ends.reserve(column_ends.size());
      for (const std::uint32_t end : column_ends) ends.push_back(static_cast<std::uint16_t>(end));
    }
  }

  std::size_t end(std::size_t column) const {
    return wide_ends.empty() ? ends[column] : wide_ends[column];
  }
  std::span<const Layer> column(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : end(i - 1);
    return {layers.data() + begin, end(i) - begin};
  }

  std::size_t bytes() const {
    std::size_t sum = kControlBlock + sizeof(Tile) + kAllocationHeader;
    for (const std::size_t size :
         {ends.capacity() * sizeof(ends[0]), wide_ends.capacity() * sizeof(wide_ends[0]),
          layers.capacity() * sizeof(layers[0])})
      if (size > 0) sum += size + kAllocationHeader;
    return sum;
  }

  bool operator==(const Tile&) const = default;
};

LayeredTerrain::LayeredTerrain(const TerrainGrid& grid) : grid_(grid) {
  check_grid(grid);
  tiles_x_ = tiles_along(grid.nx);
  tiles_.resize(static_cast<std::size_t>(tiles_x_) *
                static_cast<std::size_t>(tiles_along(grid.ny)));
  const std::vector<std::uint32_t> no_layers(std::size_t{kTileColumns} * kTileColumns);
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const ColumnArea area = tile_area(t);
    const auto columns =
        static_cast<std::size_t>((area.x_end - area.x_begin) * (area.y_end - area.y_begin));
    tiles_[t] =
        std::make_shared<const Tile>(std::span(no_layers).first(columns), std::span<Layer>());
  }
}

ColumnArea LayeredTerrain::tile_area(std::size_t tile) const {
  const int x = kTileColumns * static_cast<int>(tile % static_cast<std::size_t>(tiles_x_));
  const int y = kTileColumns * static_cast<int>(tile / static_cast<std::size_t>(tiles_x_));
  return intersection({x, y, x + kTileColumns, y + kTileColumns}, {0, 0, grid_.nx, grid_.ny});
}

std::span<const Layer> LayeredTerrain::column(int x, int y) const {
  TALUS_ASSERT(x >= 0 && x < grid_.nx && y >= 0 && y < grid_.ny);
  const int tile_x = x / kTileColumns, tile_y = y / kTileColumns;
  const int width = std::min(kTileColumns, grid_.nx - kTileColumns * tile_x);
  return tiles_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)]->column(
      static_cast<std::size_t>((y % kTileColumns) * width + x % kTileColumns));
}

Material LayeredTerrain::material(int x, int y, Steps z) const {
  if (x < 0 || x >= grid_.nx || y < 0 || y >= grid_.ny) return Material::air;
  if (z < grid_.floor) return Material::bedrock;
  for (const Layer& layer : column(x, y))
    if (z < layer.top()) return layer.material();
  return Material::air;
}

Material LayeredTerrain::material(const Vec3& p) const {
  return material(grid_.column_x(p.x), grid_.column_y(p.y), grid_.step_at(p.z));
}

std::shared_ptr<const LayeredTerrain::Tile> LayeredTerrain::edited(std::size_t tile,
                                                                   const ColumnArea& part,
                                                                   const Change& change,
                                                                   Booking& booking) const {
  const Tile& before = *tiles_[tile];
  const ColumnArea area = tile_area(tile);
  std::vector<std::uint32_t> ends;
  std::vector<Layer> layers;
  ends.reserve(std::size_t{kTileColumns} * kTileColumns);
  layers.reserve(before.layers.size());
  ColumnEditor editor(grid_.floor);
  bool changed = false;
  for (int y = area.y_begin; y < area.y_end; ++y)
    for (int x = area.x_begin; x < area.x_end; ++x) {
      std::span<const Layer> column = before.column(ends.size());
      if (part.contains(x, y)) {
        editor.load(column);
        change(x, y, editor);
        TALUS_ASSERT(well_formed(editor.layers(), grid_.floor));
        changed |= !std::ranges::equal(editor.layers(), column);
        column = editor.layers();
      }
      layers.insert(layers.end(), column.begin(), column.end());
      ends.push_back(static_cast<std::uint32_t>(layers.size()));
    }
  booking = editor.booking_;
  return changed ? std::make_shared<const Tile>(ends, layers) : tiles_[tile];
}

Booking LayeredTerrain::edit(const ColumnArea& area, const Change& change, Job* job) {
  const ColumnArea part = intersection(area, {0, 0, grid_.nx, grid_.ny});
  Booking total;
  if (part.empty()) return total;

  std::vector<std::size_t> touched;
  for (int y = part.y_begin / kTileColumns; y <= (part.y_end - 1) / kTileColumns; ++y)
    for (int x = part.x_begin / kTileColumns; x <= (part.x_end - 1) / kTileColumns; ++x)
      touched.push_back(static_cast<std::size_t>(y * tiles_x_ + x));

  std::vector<std::shared_ptr<const Tile>> made(touched.size());
  std::vector<Booking> bookings(touched.size());
  parallel_for(touched.size(), [&](std::size_t i) {
    check_cancelled(job);
    made[i] = edited(touched[i], part, change, bookings[i]);
  });
  check_cancelled(job);

  for (std::size_t i = 0; i < touched.size(); ++i) {
    tiles_[touched[i]] = std::move(made[i]);
    total.add(bookings[i]);
  }
  return total;
}

Booking LayeredTerrain::edit(const Change& change, Job* job) {
  return edit({0, 0, grid_.nx, grid_.ny}, change, job);
}

MaterialSteps LayeredTerrain::volume() const {
  MaterialSteps volume{};
  for (int y = 0; y < grid_.ny; ++y)
    for (int x = 0; x < grid_.nx; ++x) add_volume(column(x, y), grid_.floor, volume);
  return volume;
}

std::size_t LayeredTerrain::column_count() const {
  return static_cast<std::size_t>(grid_.nx) * static_cast<std::size_t>(grid_.ny);
}

std::size_t LayeredTerrain::layer_count() const {
  std::size_t count = 0;
  for (const auto& tile : tiles_) count += tile->layers.size();
  return count;
}

std::size_t LayeredTerrain::bytes() const {
  std::size_t sum = sizeof(*this) + tiles_.capacity() * sizeof(tiles_[0]) + kAllocationHeader;
  for (const auto& tile : tiles_) sum += tile->bytes();
  return sum;
}

bool LayeredTerrain::operator==(const LayeredTerrain& other) const {
  return grid_ == other.grid_ &&
         std::ranges::equal(tiles_, other.tiles_,
                            [](const auto& a, const auto& b) { return a == b || *a == *b; });
}

Steps LayeredTerrain::nearest_step(double height) const {
  const double z = std::round(height / grid_.step);
  if (!(std::abs(z) <= kStepsMax))
    throw usage_error(fmt::format(
        "a height of {} m is out of range at a vertical step of {} m, which reaches +-{} m", height,
        grid_.step, height_of(kStepsMax)));
  return static_cast<Steps>(z);
}

Steps LayeredTerrain::nearest_step(double height, Steps most) const {
  const Steps limit = std::min(most, kStepsMax);
  return height >= height_of(limit) ? limit : nearest_step(height);
}

}  // namespace talus
