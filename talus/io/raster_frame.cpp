#include "talus/io/raster_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace talus {
namespace {

constexpr double kCellTolerance = 0.01;  // cells that a raster's far corner may be off and pass
constexpr int kEdgePoints = 21;          // a bounding box is found from so many points of each edge
constexpr double kWarpBytes = 64 << 20;  // that the warper takes besides
constexpr double kFillBytes = 16;        // a cell, at most, while holes are filled
constexpr double kKernelRadius = 2;      // of cubic, the widest, in cells or pixels

Box2 unite(std::initializer_list<Vec2> points) {
  Box2 box{*points.begin(), *points.begin()};
  for (const Vec2& p : points) box = {glm::min(box.min, p), glm::max(box.max, p)};
  return box;
}

// Where a rectangle of pixels lies.
Box2 bounds(const PixelTransform& a, const Box2& pixels) {
  return unite({apply(a, pixels.min), apply(a, pixels.max), apply(a, {pixels.min.x, pixels.max.y}),
                apply(a, {pixels.max.x, pixels.min.y})});
}

bool is_metric(const OGRSpatialReference& crs) {
  if (crs.IsEmpty()) return true;
  const char* projection = crs.GetAttrValue("PROJECTION");
  const bool mercator = projection && std::string_view(projection).starts_with("Mercator");
  return crs.IsProjected() && !mercator && std::abs(crs.GetLinearUnits() - 1) < 1e-9;
}

std::string text(const Box2& box) {
  return fmt::format("[{:.10g}, {:.10g}, {:.10g}, {:.10g}]", box.min.x, box.min.y, box.max.x,
                     box.max.y);
}

// Coordinates of one system in another; absent where there are none.
class Projection {
 public:
  Projection(const OGRSpatialReference& from, const OGRSpatialReference& to)
      : projection_(OGRCreateCoordinateTransformation(&from, &to)) {}

  std::optional<Vec2> operator()(Vec2 p) const {
    if (!projection_ || !projection_->Transform(1, &p.x, &p.y) || !std::isfinite(p.x + p.y))
      return {};
    return p;
  }
  std::optional<Box2> operator()(const Box2& box) const {
    Box2 out;
    if (!projection_ ||
        !projection_->TransformBounds(box.min.x, box.min.y, box.max.x, box.max.y, &out.min.x,
                                      &out.min.y, &out.max.x, &out.max.y, kEdgePoints))
      return {};
    const Vec2 size = out.size();
    if (!(size.x > 0 && size.y > 0) || !std::isfinite(size.x + size.y)) return {};
    return out;
  }

 private:
  std::unique_ptr<OGRCoordinateTransformation> projection_;
};

OGRSpatialReference system_of(int epsg) {
  OGRSpatialReference crs;
  crs.importFromEPSG(epsg);
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

// WGS 84 / UTM, beyond its limits UPS, for a place in degrees.
OGRSpatialReference local_system(const Vec2& degrees) {
  if (degrees.y > 84) return system_of(5041);
  if (degrees.y < -80) return system_of(5042);
  const double turns = (degrees.x + 180) / 360;
  const int zone = 1 + std::min(59, static_cast<int>(60 * (turns - std::floor(turns))));
  return system_of((degrees.y >= 0 ? 32600 : 32700) + zone);
}

// The part of the raster's extent that is asked for.
Box2 cut(const std::filesystem::path& path, const Box2& extent, const std::optional<Box2>& crop) {
  if (!crop) return extent;
  const Box2 area{glm::max(extent.min, crop->min), glm::min(extent.max, crop->max)};
  if (!(area.size().x > 0 && area.size().y > 0))
    throw usage_error(fmt::format("crop: {} does not touch {}, whose extent is {}", text(*crop),
                                  path.string(), text(extent)));
  return area;
}

// Whether pixels are squares with columns to the east.
bool is_upright(const PixelTransform& a, double longest) {
  const double off = std::max({std::abs(a[2]), std::abs(a[4]), std::abs(a[1] - std::abs(a[5]))});
  return a[1] > 0 && off * longest < kCellTolerance * a[1];
}

// The pixels of the area become cells of the wanted size, from which they differ by rounding.
void keep_pixels(const Box2& area, const RasterSource& source, std::optional<double> wanted,
                 RasterFrame& frame) {
  const PixelTransform& a = frame.source;
  const double first_y = a[5] < 0 ? area.max.y : area.min.y;
  const auto first = [](double pixels, int count) {
    return static_cast<int>(std::clamp(std::round(pixels), 0.0, count - 1.0));
  };
  frame.window.x = first((area.min.x - a[0]) / a[1], source.nx());
  frame.window.y = first((first_y - a[3]) / a[5], source.ny());
  const auto count = [](double pixels, int left) {
    return static_cast<int>(std::clamp(std::round(pixels), 1.0, static_cast<double>(left)));
  };
  frame.window.nx = count(area.size().x / a[1], source.nx() - frame.window.x);
  frame.window.ny = count(area.size().y / std::abs(a[5]), source.ny() - frame.window.y);

  frame.nx = frame.window.nx;
  frame.ny = frame.window.ny;
  frame.cell = wanted.value_or(mean_cell(a));
  const Vec2 corner(frame.window.x, frame.window.y);
  frame.corner = bounds(a, {corner, corner + Vec2(frame.nx, frame.ny)}).min;
}

// The pixels that the kernel reaches from the target, of the whole raster if that cannot be told.
PixelWindow reached_pixels(const std::optional<Box2>& target, double pixels_to_cell,
                           const RasterSource& source, const RasterFrame& frame) {
  const PixelWindow whole{0, 0, source.nx(), source.ny()};
  PixelTransform a = frame.source, pixel_from_place{};
  if (!target || !GDALInvGeoTransform(a.data(), pixel_from_place.data())) return whole;
  const double margin = kKernelRadius * std::max(1.0, pixels_to_cell) + 2;
  Box2 pixels = bounds(pixel_from_place, *target);
  const Vec2 size(source.nx(), source.ny());
  pixels.min = glm::clamp(glm::floor(pixels.min - margin), Vec2(0), size - 1.0);
  pixels.max = glm::clamp(glm::ceil(pixels.max + margin), pixels.min + 1.0, size);
  const Vec2 extent = pixels.size();
  return {static_cast<int>(pixels.min.x), static_cast<int>(pixels.min.y),
          static_cast<int>(extent.x), static_cast<int>(extent.y)};
}

// Refuses what would not fit, with what would.
void check_memory(const std::filesystem::path& path, double nx, double ny, const RasterFrame& frame,
                  const ReadRasterParams& params) {
  const double cells = nx * ny;
  const double pixels = static_cast<double>(frame.window.nx) * frame.window.ny;
  double need = sizeof(float) * cells;
  if (frame.resampled) need += sizeof(float) * pixels + kWarpBytes;
  if (params.holes == HoleMode::fill) need += kFillBytes * cells;
  const auto limit = static_cast<double>(params.memory_limit);
  constexpr int kMost = std::numeric_limits<int>::max();
  if (need <= limit && nx <= kMost && ny <= kMost) return;
  throw job_error(fmt::format(
      "{}: {:.0f} x {:.0f} cells of {:.4g} m from {} x {} pixels take {:.4g} GiB, the memory limit "
      "is {:.4g} GiB; read less (crop), use larger cells (cell), or raise the limit",
      path.string(), nx, ny, frame.cell, frame.window.nx, frame.window.ny, need / (1 << 30),
      limit / (1 << 30)));
}

}  // namespace

RasterFrame choose_frame(const std::filesystem::path& path, const RasterSource& source,
                         const ReadRasterParams& params) {
  if (params.pixel_size && source.transform())
    throw usage_error(
        fmt::format("pixel_size: {} is georeferenced, so that its pixels have a size; "
                    "leave it out",
                    path.string()));
  RasterFrame frame{.crs = source.crs()};
  const double made_up = params.pixel_size.value_or(params.cell.value_or(1));
  frame.source = source.transform().value_or(
      PixelTransform{0, made_up, 0, made_up * source.ny(), 0, -made_up});
  const Vec2 size(source.nx(), source.ny());
  const Box2 area = cut(path, bounds(frame.source, {Vec2(0), size}), params.crop);

  // Without a metric frame of its own the raster goes to that of the area's center.
  Box2 target = area;
  double cell = mean_cell(frame.source);
  const bool projected = !is_metric(source.crs());
  if (projected) {
    const Vec2 center = 0.5 * (area.min + area.max);
    const std::optional<Vec2> degrees = Projection(source.crs(), system_of(4326))(center);
    if (degrees) frame.crs = local_system(*degrees);
    const Projection project(source.crs(), frame.crs);
    const std::optional<Box2> projected_area = project(area);
    const PixelTransform& a = frame.source;
    const std::optional<Vec2> middle = project(center), right = project(center + Vec2(a[1], a[4])),
                              down = project(center + Vec2(a[2], a[5]));
    if (!degrees || !projected_area || !middle || !right || !down)
      throw input_error(fmt::format("{}: {} cannot be laid flat; read less of it (crop)",
                                    path.string(), text(area)));
    target = *projected_area;
    const Vec2 u = *right - *middle, v = *down - *middle;
    cell = std::sqrt(std::abs(u.x * v.y - u.y * v.x));
  }

  const double longest = std::max(size.x, size.y);
  const double native = cell;
  if (params.cell) cell = *params.cell;
  frame.resampled = projected || !is_upright(frame.source, longest) ||
                    std::abs(cell - native) * longest > kCellTolerance * native;
  if (!frame.resampled) {
    keep_pixels(area, source, params.cell, frame);
    check_memory(path, frame.nx, frame.ny, frame, params);
    return frame;
  }

  // Cells from the south-west corner on, as many as come closest to the area.
  const Vec2 count = glm::max(glm::round(target.size() / cell), Vec2(1));
  frame.cell = cell;
  frame.corner = target.min;
  std::optional<Box2> needed = Box2{target.min, target.min + cell * count};
  if (projected) needed = Projection(frame.crs, source.crs())(*needed);
  frame.window = reached_pixels(needed, cell / native, source, frame);
  check_memory(path, count.x, count.y, frame, params);
  frame.nx = static_cast<int>(count.x);
  frame.ny = static_cast<int>(count.y);
  return frame;
}

PixelTransform target_transform(const RasterFrame& frame) {
  return {frame.corner.x, frame.cell, 0, frame.corner.y + frame.cell * frame.ny, 0, -frame.cell};
}

}  // namespace talus
