#include "talus/piles/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "talus/base/error.h"
#include "talus/base/hash.h"

namespace talus {
namespace {

constexpr int kSamples = 3;  // along each edge of a pixel
constexpr Vec3 kGap(26, 24, 23);
constexpr Vec3 kMark(224, 48, 40);

// What shows at each sample: 0 the gap, 1 a mark, from 2 on the solids.
constexpr std::uint32_t kFirstSolid = 2;

// Earth colors that differ in hue a little and in lightness a lot.
Vec3 color_of(std::uint32_t label) {
  if (label == 0) return kGap;
  if (label == 1) return kMark;
  const auto draw = [&](int k) { return uniform(hash(7, Purpose::stone_color, label, k)); };
  const double light = 90 + 130 * draw(0), warm = 26 * draw(1), green = 8 * (draw(2) - 0.5);
  return {light + warm, light + green, light - warm};
}

class Canvas {
 public:
  explicit Canvas(const Section& section)
      : section_(section),
        scale_(kSamples * section.width / (section.max.x - section.min.x)),
        width_(kSamples * section.width),
        height_(kSamples * pixel_rows()),
        labels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0),
        crossings_(static_cast<std::size_t>(height_)) {}

  // Along each row of samples the boundary is entered and left in turn.
  void fill(std::span<const std::pair<Vec2, Vec2>> boundary, std::uint32_t label) {
    int low = height_, high = -1;
    for (const auto& [from, to] : boundary) {
      Vec2 a = sample(from), b = sample(to);
      if (a.y > b.y) std::swap(a, b);
      const int begin = std::max(0, first_center(a.y)), end = std::min(height_, first_center(b.y));
      for (int row = begin; row < end; ++row)
        crossings_[static_cast<std::size_t>(row)].push_back(
            a.x + (b.x - a.x) * ((row + 0.5 - a.y) / (b.y - a.y)));
      low = std::min(low, begin);
      high = std::max(high, end);
    }
    for (int row = low; row < high; ++row) {
      std::vector<double>& xs = crossings_[static_cast<std::size_t>(row)];
      std::sort(xs.begin(), xs.end());
      for (std::size_t k = 0; k + 1 < xs.size(); k += 2) fill_row(row, xs[k], xs[k + 1], label);
      xs.clear();
    }
  }

  void dot(const Vec2& center, double radius) {
    const Vec2 c = sample(center);
    const double r = radius * scale_;
    for (int row = std::max(0, first_center(c.y - r));
         row < std::min(height_, first_center(c.y + r)); ++row) {
      const double up = row + 0.5 - c.y, across = std::sqrt(std::max(0.0, r * r - up * up));
      fill_row(row, c.x - across, c.x + across, 1);
    }
  }

  Image image() const {
    Image image{.width = section_.width, .height = height_ / kSamples};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        Vec3 sum(0);
        for (int k = 0; k < kSamples * kSamples; ++k)
          sum += color_of(labels_[index(kSamples * x + k % kSamples, kSamples * y + k / kSamples)]);
        for (int channel = 0; channel < 3; ++channel)
          image.pixels.push_back(static_cast<std::uint8_t>(
              std::clamp(sum[channel] / (kSamples * kSamples), 0.0, 255.0)));
      }
    return image;
  }

 private:
  int pixel_rows() const {
    const Vec2 size = section_.max - section_.min;
    return std::max(1, static_cast<int>(std::lround(section_.width * size.y / size.x)));
  }
  Vec2 sample(const Vec2& p) const {
    return {(p.x - section_.min.x) * scale_, (section_.max.y - p.y) * scale_};
  }
  // The first row, or column, whose center is not below.
  static int first_center(double at) { return static_cast<int>(std::ceil(at - 0.5)); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(width_) * static_cast<std::size_t>(y);
  }
  void fill_row(int row, double from, double to, std::uint32_t label) {
    const int begin = std::clamp(first_center(from), 0, width_);
    const int end = std::clamp(first_center(to), begin, width_);
    std::fill_n(labels_.begin() + static_cast<std::ptrdiff_t>(index(begin, row)), end - begin,
                label);
  }

  Section section_;
  double scale_;  // samples in a metre
  int width_, height_;
  std::vector<std::uint32_t> labels_;
  std::vector<std::vector<double>> crossings_;  // of each row, for the solid at hand
};

// Where a mesh's triangles cross the height.
void cut(const TriangleMesh& mesh, const Instance& instance, double height,
         std::vector<std::pair<Vec2, Vec2>>& boundary) {
  boundary.clear();
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t c = 0; c < 3; ++c)
      p[c] = world_from_local(instance, mesh.positions[t[static_cast<int>(c)]]);
    std::array<Vec2, 2> ends;
    std::size_t found = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 &a = p[c], &b = p[(c + 1) % 3];
      if ((a.z >= height) != (b.z >= height))
        ends[found++] = Vec2(a + (b - a) * ((height - a.z) / (b.z - a.z)));
    }
    if (found == 2) boundary.emplace_back(ends[0], ends[1]);
  }
}

}  // namespace

Image draw_section(const InstanceTable& solids, const Section& section, std::span<const Vec2> marks,
                   double mark_radius) {
  const Vec2 size = section.max - section.min;
  if (!(size.x > 0 && size.y > 0))
    throw usage_error("the section is empty: what it shows has no extent");
  if (section.width * size.y / size.x > kSectionMaxRows)
    throw usage_error(
        fmt::format("a section of {:.4g} x {:.4g} m, {} pixels wide, is more than {} pixels high; "
                    "make it narrower",
                    size.x, size.y, section.width, kSectionMaxRows));
  Canvas canvas(section);
  std::vector<std::pair<Vec2, Vec2>> boundary;
  for (std::size_t i = 0; i < solids.instances.size(); ++i) {
    const Instance& instance = solids.instances[i];
    cut(*solids.prototypes[instance.prototype], instance, section.height, boundary);
    canvas.fill(boundary, kFirstSolid + static_cast<std::uint32_t>(i));
  }
  for (const Vec2& mark : marks) canvas.dot(mark, mark_radius);
  return canvas.image();
}

std::vector<Vec2> contacts_near(const Pile& pile, double height) {
  const TileParams& params = pile.tiles->params();
  const double voxel = static_cast<double>(params.n) / params.voxels();  // in cells
  std::vector<Vec2> found;
  for (const PlacedStone& placed : placed_stones(pile))
    for (const StoneContact& contact : pile.tiles->stones()[placed.stone].contacts) {
      const Vec3 place = pile.tiling.world(Vec3(placed.cell) + 0.5 * voxel * Vec3(contact.face));
      if (contact.kept && std::abs(place.z - height) <= 0.5 * voxel * pile.tiling.cell_size)
        found.emplace_back(place);
    }
  return found;
}

}  // namespace talus
