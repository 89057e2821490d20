#include "talus/scene/source.h"

#include <utility>

#include "talus/base/angle.h"
#include "talus/field/formula.h"
#include "talus/field/height_interval.h"
#include "talus/io/digest.h"
#include "talus/io/mesh_reader.h"
#include "talus/terrain/layer_support.h"

namespace talus {
namespace {

void place(TriangleMesh& mesh, const Placement& placement) {
  if (placement.rotate_deg == Vec3(0) && placement.at == Vec3(0)) return;
  const glm::dmat3 rotation = rotation_deg(placement.rotate_deg);
  for (Vec3f& p : mesh.positions) p = Vec3f(rotation * Vec3(p) + placement.at);
}

}  // namespace

Source open_source(const MeshSource& source, BuildContext& context, const std::string& name,
                   const Placement& placement) {
  const StageTimer timer;
  ReadMeshResult read = read_mesh(source.mesh, source.read);
  for (const std::string& warning : read.warnings) warn(context.job, warning);
  place(read.mesh, placement);
  Digest digest;
  digest.add(std::span(std::as_const(read.mesh.positions)));
  digest.add(std::span(std::as_const(read.mesh.triangles)));
  context.result.stages.push_back(timer.stop(name + ": read mesh"));
  return {.made_of = std::move(read.mesh), .file = source.mesh.string(), .key = digest.hex()};
}

Source open_source(const Shape& shape, BuildContext&, const std::string&) {
  return {.made_of = shape, .key = to_text(write_value(shape))};
}

Source open_source(const FormulaSource& formula, BuildContext& context, const std::string&) {
  const std::uint64_t seed = context.result.recipe.seed;
  return {.made_of = formula,
          .seed = seed,
          .key = fmt::format("{} {}", seed, to_text(write_value(formula)))};
}

Source open_source(const HeightsSource& heights, BuildContext& context, const std::string& name) {
  const StageTimer timer;
  ReadRasterParams params = heights.read;
  params.memory_limit = context.memory_limit;
  ReadRasterResult lower = read_raster(heights.lower, params, context.job);
  ReadRasterResult upper = read_raster(heights.upper, params, context.job);
  for (const ReadRasterResult* read : {&lower, &upper})
    for (const std::string& warning : read->warnings) warn(context.job, warning);
  const Georeference &a = lower.georeference, &b = upper.georeference;
  if (a.crs != b.crs || a.offset != b.offset)
    throw usage_error(fmt::format(
        "{} begins at ({:.6f}, {:.6f}) {} and {} at ({:.6f}, {:.6f}) {}; give two rasters of the "
        "same place, or crop them to it",
        heights.lower.string(), a.offset.x, a.offset.y, a.crs, heights.upper.string(), b.offset.x,
        b.offset.y, b.crs));
  HeightInterval interval{std::move(lower.grid), std::move(upper.grid)};
  if (context.terrain && !b.crs.empty() && b.crs == context.terrain->georeference.crs)
    interval.corner = b.offset - context.terrain->georeference.offset;
  Digest digest;
  for (const HeightGrid* grid : {&interval.lower, &interval.upper}) {
    digest.add(grid->nx);
    digest.add(grid->cell);
    digest.add(std::span(grid->heights));
  }
  digest.add(interval.corner.x);
  digest.add(interval.corner.y);
  context.result.stages.push_back(timer.stop(name + ": read rasters"));
  return {.made_of = std::move(interval), .file = heights.upper.string(), .key = digest.hex()};
}

Source open_source(const LayerSource& layer, BuildContext& context, const std::string&) {
  const std::string material(material_info(layer.material).name);
  if (!context.terrain)
    throw usage_error(
        fmt::format("there is no terrain whose layers of {} could be filled; put an operation that "
                    "makes one before it",
                    material));
  return {.made_of = layer,
          .terrain = context.terrain->terrain,
          .key = material + context.terrain->key};
}

MadeSupport make_support(const Source& source, Job* job) {
  if (const auto* shape = std::get_if<Shape>(&source.made_of))
    return {.support = std::make_unique<const ShapeSupport>(*shape)};
  if (const auto* f = std::get_if<FormulaSource>(&source.made_of))
    return {.support = std::make_unique<const FormulaSupport>(f->formula, Box3{f->min, f->max},
                                                              source.seed)};
  if (const auto* heights = std::get_if<HeightInterval>(&source.made_of))
    return {.support = std::make_unique<const HeightIntervalSupport>(heights->lower, heights->upper,
                                                                     heights->corner)};
  if (const auto* layer = std::get_if<LayerSource>(&source.made_of))
    return {.support = std::make_unique<const LayerSupport>(*source.terrain,
                                                            MaterialSet{layer->material})};
  try {
    auto mesh = std::make_unique<const MeshSupport>(std::get<TriangleMesh>(source.made_of), job);
    const MeshSupportReport report = mesh->report();
    return {std::move(mesh), report};
  } catch (const Error& error) {
    // The mesh does not know its file.
    throw Error(error.kind(), fmt::format("{}: {}", source.file, error.what()));
  }
}

void warn_about(const MeshSupportReport& report, const std::string& file, Job* job) {
  if (report.boundary_edges > 0)
    warn(job, fmt::format("{}: the mesh is open ({} edges with one triangle); its holes are closed "
                          "by its winding number",
                          file, report.boundary_edges));
  if (report.inverted) warn(job, fmt::format("{}: the mesh faces inward; it is turned", file));
  if (report.flipped > 0)
    warn(job, fmt::format("{}: {} triangles disagree with their neighbors; they are turned", file,
                          report.flipped));
  if (report.overlapping)
    warn(job, fmt::format("{}: the mesh crosses or overlaps itself; the union is filled", file));
  if (report.non_manifold_edges > 0)
    warn(job,
         fmt::format("{}: {} edges have more than two triangles", file, report.non_manifold_edges));
}

}  // namespace talus
