// Which materials show at a place of the ground.
#pragma once

#include <array>
#include <vector>

#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/field_sampler.h"

namespace talus {

static_assert(kMaterialCount <= std::tuple_size_v<MaterialShares>);

// Measures, in the cube of a field's half-width around a point, the faces of its materials' layers
// that touch what is not one of them ([Peytavie2010] §2.5.1.2): tops, undersides, and the sides
// between neighboring columns. Beyond the border the border columns go on outward, so nothing shows
// there. Holds working memory: one for each thread.
class VisibleShares {
 public:
  // Looks through a sampler, which must outlive it.
  explicit VisibleShares(FieldSampler& sampler)
      : sampler_(&sampler), materials_(sampler.field().materials()) {}

  // Square metres of each material; points in grid units. Faces on the cube's
  // own surface do not count.
  using Areas = std::array<double, kMaterialCount>;
  const Areas& areas(const Vec3& g);

  // The areas' shares in 255ths, indexed by material; the rounding sums to 255 by largest
  // remainders. Where nothing shows, the nearest layer of the materials in the point's column.
  MaterialShares at(const Vec3& g);

 private:
  // A layer's part inside the cube.
  struct Run {
    double top;
    Material material;
    bool inside;
  };
  using Runs = std::vector<Run>;

  void clip(std::span<const Layer> column, double low, double high, Runs& runs) const;
  void add_levels(const Runs& runs, double area);
  void add_sides(const Runs& a, const Runs& b, double bottom, double width);
  std::uint32_t materials_within(const Vec3& g);
  Material nearest(const Vec3& g) const;
  const TerrainGrid& grid() const { return sampler_->field().terrain().grid(); }

  FieldSampler* sampler_;
  MaterialSet materials_;
  Areas areas_{};
  std::vector<Runs> below_;  // of the row of columns before
  Runs left_, here_;
};

}  // namespace talus
