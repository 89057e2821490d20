#include "talus/scene/recipe.h"

#include "talus/io/read_file.h"

namespace talus {
namespace {

void visit_file(HeightmapOperation& o, auto&& change) { change(o.file); }
void visit_file(MeshBedrockOperation& o, auto&& change) { change(o.mesh.mesh); }
void visit_file(auto& o, auto&& change) {
  if constexpr (requires { o.support; })
    if (auto* source = std::get_if<MeshSource>(&o.support)) change(source->mesh);
}

// Calls `change(path)` for every file name in the recipe.
void for_each_file(Recipe& recipe, auto&& change) {
  for (Operation& operation : recipe.operations)
    std::visit([&](auto& params) { visit_file(params, change); }, operation);
}

}  // namespace

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
