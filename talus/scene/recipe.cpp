#include "talus/scene/recipe.h"

#include "talus/io/read_file.h"

namespace talus {
namespace {

void visit_file(HeightmapOperation& o, auto&& change) { change(o.file); }
void visit_file(MeshBedrockOperation& o, auto&& change) { change(o.mesh.mesh); }
void visit_mask(BrushSource& region, auto&& change) {
  if (region.mask) change(*region.mask);
}
void visit_file(DepositOperation& o, auto&& change) {
  visit_mask(o.region, change);
  if (o.map) change(*o.map);
}
void visit_file(ErodeSurfaceOperation& o, auto&& change) { visit_mask(o.region, change); }
void visit_support(auto& support, auto&& change) {
  if (auto* source = std::get_if<MeshSource>(&support)) change(source->mesh);
  if (auto* source = std::get_if<HeightsSource>(&support)) {
    change(source->lower);
    change(source->upper);
  }
}
void visit_file(PileOperation& o, auto&& change) {
  visit_support(o.support, change);
  for (PileSource& support : o.control.keep_out) visit_support(support, change);
  if (o.control.density_mask) change(*o.control.density_mask);
}
void visit_file(auto& o, auto&& change) {
  if constexpr (requires { o.support; }) visit_support(o.support, change);
}

// Calls `change(path)` for every file name in the recipe.
void for_each_file(Recipe& recipe, auto&& change) {
  for (Operation& operation : recipe.operations)
    std::visit([&](auto& params) { visit_file(params, change); }, operation.params);
  for (SurfaceParams& surface : recipe.surfaces.of_material)
    for (auto* file : {&surface.albedo, &surface.normal, &surface.roughness, &surface.height})
      if (*file) change(**file);
}

}  // namespace

void read_value(const Value& value, const std::string& path, ViewParams& out) {
  read_fields(value, path, out);
  const Value* eye = value.find("eye");
  const Value* target = value.find("target");
  const Value* camera = value.find("camera");
  if (const Value* alone = !target ? eye : !eye ? target : nullptr)
    fail_at(alone->where, path, "give \"eye\" and \"target\" together, or none of them");
  if (out.camera == CameraPreset::inside && !eye)
    fail_at(camera->where, path, "camera = \"inside\" needs \"eye\" and \"target\"");

  const auto refuse = [&](std::string_view key, std::string_view because) {
    if (const Value* idle = value.find(key))
      fail_at(idle->where, joined_path(path, key),
              fmt::format("has no effect beside {}; leave one of them out", because));
  };
  if (eye) {
    refuse("azimuth_deg", "\"eye\"");
    refuse("elevation_deg", "\"eye\"");
    refuse("zoom", "\"eye\"");
  } else if (out.camera == CameraPreset::low) {
    refuse("elevation_deg", "camera = \"low\"");
    refuse("zoom", "camera = \"low\"");
  }
}

Recipe read_recipe(const Value& document, const std::filesystem::path& folder) {
  Recipe recipe;
  read_value(document, "", recipe);
  if (recipe.operations.empty())
    fail_at(document.where, "", "there is no [[operation]]; a recipe needs at least one");
  for_each_file(recipe, [&](std::filesystem::path& file) { file = folder / file; });
  return recipe;
}

Recipe load_recipe(const std::filesystem::path& file, const std::function<Value(Value)>& change) {
  return read_recipe(change(parse_document(read_file(file), file.string())), file.parent_path());
}

std::string to_toml(const Recipe& recipe, const std::filesystem::path& folder) {
  Recipe relative = recipe;
  for_each_file(relative, [&](std::filesystem::path& file) {
    if (!file.is_absolute() || !folder.empty())
      file = std::filesystem::proximate(file, folder.empty() ? "." : folder);
  });
  Value document = write_fields(relative);
  auto& table = std::get<Value::Table>(document.data);
  if (!document.find("seed")) table.insert(table.begin(), {"seed", write_value(recipe.seed)});
  return to_toml(document);
}

}  // namespace talus
