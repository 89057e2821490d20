// Supports while a recipe is built.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "talus/field/height_grid.h"
#include "talus/field/mesh_support.h"
#include "talus/field/support.h"
#include "talus/scene/build_context.h"
#include "talus/scene/support_source.h"

namespace talus {

// Two surfaces, whose plan's south-west corner is put somewhere.
struct HeightInterval {
  HeightGrid lower;
  HeightGrid upper;
  Vec2 corner{0};
};

// What a support is made of, and what identifies it: enough to know whether a cached result is of
// the same, before the support itself is made.
struct Source {
  std::variant<TriangleMesh, Shape, FormulaSource, HeightInterval, LayerSource> made_of;
  std::optional<LayeredTerrain> terrain;  // of layers
  std::uint64_t seed = 0;                 // of a formula's noise
  std::string file;                       // of a mesh, for messages
  std::string key;
};

// Reads the mesh, if it is one, as a stage of the operation `name`; a placed mesh is moved. Throws
// as `read_mesh`; `Error` (usage) for layers without a terrain.
Source open_source(const MeshSource& source, BuildContext& context, const std::string& name,
                   const Placement& placement = {});
Source open_source(const Shape& shape, BuildContext& context, const std::string& name);
Source open_source(const FormulaSource& formula, BuildContext& context, const std::string& name);
// Reads the rasters as a stage. They begin at (0, 0), or where they lie beside the raster that set
// the terrain's extent, if that and they have the same coordinate system. Throws as `read_raster`;
// `Error` (usage) if one of the rasters lies elsewhere than the other.
Source open_source(const HeightsSource& heights, BuildContext& context, const std::string& name);
Source open_source(const LayerSource& layer, BuildContext& context, const std::string& name);

struct MadeSupport {
  std::unique_ptr<const Support> support;
  std::optional<MeshSupportReport> mesh;  // what was found about a mesh
};
// Throws as the support's constructor, naming the file.
MadeSupport make_support(const Source& source, Job* job);

// Tells the job what is unusual about a mesh.
void warn_about(const MeshSupportReport& report, const std::string& file, Job* job);

}  // namespace talus
