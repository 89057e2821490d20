#include "apps/talus/verbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/talus/builtin_scene.h"
#include "apps/talus/camera_options.h"
#include "apps/talus/inspection.h"
#include "apps/talus/picture.h"
#include "apps/talus/texts.h"
#include "talus/io/mesh_reader.h"
#include "talus/io/png.h"
#include "talus/io/scene_reader.h"
#include "talus/io/tile_set_file.h"
#include "talus/scene/build.h"
#include "talus/scene/cache.h"
#include "talus/scene/outputs.h"
#include "talus/scene/report.h"

namespace talus::cli {
namespace {

namespace fs = std::filesystem;

// What the options of `tiles` say.
struct TilesRecipe {
  std::uint64_t seed = Recipe{}.seed;
  TileParams tiles;
  static void describe(auto& p, auto&& field) {
    field(p.seed, Field{.name = "seed", .help = "", .min = 0});
    TileParams::describe(p.tiles, field);
  }
};

// What the options of `render` say about a mesh file.
struct MeshView {
  ReadMeshParams read;
  ViewParams view;
  static void describe(auto& p, auto&& field) {
    ReadMeshParams::describe(p.read, field);
    field(p.view, Field{.name = "view", .help = ""});
  }
};

void print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw job_error("standard output: " + std::generic_category().message(errno));
}

BuildParams build_params(const Command& command) {
  BuildParams params;
  const fs::path folder = default_cache_folder();
  if (command.cache && !folder.empty()) params.cache_folder = folder;
  if (command.memory_limit) params.memory_limit = *command.memory_limit;
  return params;
}

Value with_options(Value document, const Command& command) {
  for (const Setting& option : command.options)
    set_value(document, option.path, option.text, option.where);
  for (const std::string& setting : command.settings) apply_setting(document, setting);
  let_command_place_camera(document, command);
  return document;
}

Recipe recipe_of_scene(const Command& command) {
  if (command.subject.empty())
    return read_recipe(with_options(parse_document(kBuiltinScene, "the built-in scene"), command));
  return load_recipe(command.subject,
                     [&](Value document) { return with_options(std::move(document), command); });
}

Recipe recipe_of_pile(const Command& command) {
  const Value operation{Value::Table{{"type", {std::string(PileOperation::kName)}},
                                     {"support", parse_support(command.subject, command.subject)}}};
  const Value document{Value::Table{{"operation", {Value::Array{operation}}}}};
  return read_recipe(with_options(document, command));
}

void save_recipe(const Recipe& recipe, const fs::path& file) {
  write_text(file, to_toml(recipe, file.has_parent_path() ? file.parent_path() : "."));
}

std::string summary(const BuildResult& result, const Report& report,
                    const std::vector<fs::path>& files) {
  std::string text;
  if (report.terrain) {
    const TerrainReport& terrain = *report.terrain;
    text += fmt::format("terrain of {} columns, {:.6g} x {:.6g} m, {} triangles\n", terrain.columns,
                        terrain.size_m[0], terrain.size_m[1],
                        result.terrain->ground.mesh.triangles.size());
  }
  if (report.stones) {
    const Vec3 size = bounds(result.stones).size();
    text += fmt::format("{} stones of {} meshes, {:.3g} x {:.3g} x {:.3g} m\n",
                        report.stones->instances, result.stones.prototypes.size(), size.x, size.y,
                        size.z);
  }
  const auto kept = std::count_if(result.stages.begin(), result.stages.end(),
                                  [](const Stage& stage) { return stage.cached; });
  if (kept > 0) text += fmt::format("{} of {} steps from the cache\n", kept, result.stages.size());
  for (const fs::path& file : files) text += file.string() + "\n";
  return text;
}

// The preview; none on a machine without OpenGL, which still gets its scene.
std::optional<Image> draw_preview(const BuildResult& result, const std::vector<SurfaceLook>& looks,
                                  Console& console) {
  try {
    return draw(result, looks, &console);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::job) throw;
    console.warn(std::string("no preview is drawn: ") + error.what());
    return std::nullopt;
  }
}

// Writes a scene into a folder and examines it. The preview is drawn meanwhile: drawing leaves a
// processor idle.
void write_results(const BuildResult& result, const std::vector<SurfaceLook>& looks,
                   const fs::path& folder, const Command& command, Console& console) {
  // An older picture would show another scene.
  const fs::path picture = folder / "preview.png";
  std::error_code none_there;
  fs::remove(picture, none_there);
  const StageTimer timer;
  std::future<std::optional<Image>> preview;
  if (command.preview)
    preview = std::async(std::launch::async, draw_preview, std::cref(result), std::cref(looks),
                         std::ref(console));

  std::vector<fs::path> files = write_scene(result, folder, &console);
  const Stage write = timer.stop("write");
  const StageTimer check_timer;
  Report report = make_report(result, folder);
  report.stages.insert(report.stages.end(), {write, check_timer.stop("check")});
  if (preview.valid()) {
    if (const std::optional<Image> image = preview.get()) {
      write_png(picture, *image);
      files.push_back(picture);
    }
    report.stages.push_back(timer.stop("preview"));
  }

  for (const Check& check : report.checks)
    if (!check.ok) console.warn(check.name + ": " + check.detail);
  const std::string json = to_json(report) + "\n";
  files.push_back(folder / "report.json");
  write_text(files.back(), json);

  console.clear_bar();
  if (command.json)
    print(json);
  else if (!command.quiet)
    print(summary(result, report, files));
}

// From a recipe to a folder of results.
void make_scene(const Recipe& recipe, const fs::path& output, const Command& command,
                Console& console) {
  const OutputFolder folder(output);
  if (command.save_scene) check_writable_file(*command.save_scene);
  const std::vector<SurfaceLook> looks = read_looks(recipe.surfaces);
  const BuildResult result = build(recipe, build_params(command), &console);
  if (command.save_scene) save_recipe(recipe, *command.save_scene);
  write_results(result, looks, folder.path(), command, console);
}

void run_build(const Command& command, Console& console) {
  const Recipe recipe = recipe_of_scene(command);
  const fs::path name = command.subject.empty() ? "ravine" : fs::path(command.subject).stem();
  make_scene(recipe, command.output.value_or("out" / name), command, console);
}

void run_pile(const Command& command, Console& console) {
  make_scene(recipe_of_pile(command), *command.output, command, console);
}

void run_tiles(const Command& command, Console& console) {
  TilesRecipe recipe;
  read_value(with_options({}, command), "", recipe);
  validate_tiles(recipe.tiles);
  check_writable_file(*command.output);
  const MadeTiles made = make_tiles(recipe.tiles, recipe.seed, build_params(command), &console);
  save_tile_set(*command.output, *made.tiles);

  const Report report = make_report(made);
  console.clear_bar();
  if (command.json)
    print(to_json(report) + "\n");
  else if (!command.quiet)
    print(tiles_text(*report.tiles) +
          fmt::format("{}, {:.1f} MB\n", command.output->string(),
                      static_cast<double>(fs::file_size(*command.output)) / 1e6));
}

// The cut that is asked for.
Image section_of(const InstanceTable& stones, const ViewParams& view, const Command& command) {
  if (stones.instances.empty())
    throw usage_error("--section: the scene has no stones to cut; leave it out for a view");
  return draw_section(stones, *command.section, view.width);
}

Image picture_of(const Recipe& recipe, const Command& command, Console& console) {
  const std::vector<SurfaceLook> looks = read_looks(recipe.surfaces);
  const BuildResult result = build(recipe, build_params(command), &console);
  if (command.section) return section_of(result.stones, recipe.view, command);
  return draw(result, looks, &console);
}

Image picture_of(const SceneFile& scene, const SurfacesParams& surfaces, const ViewParams& view,
                 const Command& command, Console& console) {
  if (command.section) return section_of(scene.stones, view, command);
  return draw(scene, read_looks(surfaces), view, &console);
}

Image picture_of_tiles(const ViewParams& view, const Command& command, Console& console) {
  const auto tiles = std::make_shared<const TileSet>(load_tile_set(command.subject));
  if (command.section) return draw_section(tiles, *command.section, view.width);
  return draw(*tiles, view, &console);
}

Image picture_of_mesh(const fs::path& file, const MeshView& mesh_view, const Command& command,
                      Console& console) {
  ReadMeshResult read = read_mesh(file, mesh_view.read);
  for (const std::string& warning : read.warnings) console.warn(warning);
  if (!command.section) return draw(read.mesh, mesh_view.view, &console);
  InstanceTable table{.instances = {{}}};
  table.prototypes = {std::make_shared<const TriangleMesh>(std::move(read.mesh))};
  return section_of(table, mesh_view.view, command);
}

// Whether the command changes how the scene is seen, and nothing of the scene.
bool only_concerns_picture(const Command& command) {
  const auto concerns = [](std::string_view path) {
    return path.starts_with("view.") || path.starts_with("surfaces.");
  };
  return std::all_of(command.options.begin(), command.options.end(),
                     [&](const Setting& option) { return concerns(option.path); }) &&
         std::all_of(command.settings.begin(), command.settings.end(), concerns);
}

// The picture of a folder of results: of its scene.glb, or, if that holds no stones by themselves,
// is missing or older, or if other values are set, of its recipe built once more.
Image picture_of_results(const fs::path& folder, const Command& command, Console& console) {
  const Recipe recipe = load_reported_recipe(folder / "report.json", [&](Value document) {
    return with_options(std::move(document), command);
  });
  const fs::path written = folder / "scene.glb";
  std::error_code error;  // what cannot be looked at is refused when it is read
  const std::vector<Format> formats = formats_of(recipe.output);
  const bool is_written = std::find(formats.begin(), formats.end(), Format::glb) != formats.end();
  if (only_concerns_picture(command) && is_written && fs::exists(written, error))
    if (const std::optional<SceneFile> scene = read_scene(written))
      return picture_of(*scene, recipe.surfaces, recipe.view, command, console);
  return picture_of(recipe, command, console);
}

// The picture of a recipe, a folder of results, a scene, a tile set or a mesh file.
Image picture_of(const Command& command, Console& console) {
  const fs::path subject = command.subject;
  if (subject.extension() == ".toml") return picture_of(recipe_of_scene(command), command, console);
  std::error_code error;  // likewise
  if (fs::exists(subject / "report.json", error))
    return picture_of_results(subject, command, console);

  const fs::path file = fs::is_directory(subject, error) ? subject / "scene.glb" : subject;
  const bool is_tiles = is_tile_set_file(file);
  MeshView mesh_view;
  if (is_tiles) mesh_view.view = specimens_view();
  read_value(with_options({}, command), "", mesh_view);
  if (is_tiles) return picture_of_tiles(mesh_view.view, command, console);
  if (lower_case(file.extension().string()) == ".glb" && only_concerns_picture(command))
    if (const std::optional<SceneFile> scene = read_scene(file))
      return picture_of(*scene, {}, mesh_view.view, command, console);
  return picture_of_mesh(file, mesh_view, command, console);
}

// Throws for a name that promises another format than is written.
void check_picture_name(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  if (!extension.empty() && extension != ".png")
    throw usage_error(fmt::format("{}: pictures are written as PNG; name it {}", file.string(),
                                  fs::path(file).replace_extension(".png").string()));
}

void run_render(const Command& command, Console& console) {
  check_picture_name(*command.output);
  check_writable_file(*command.output);
  const Image image = picture_of(command, console);
  write_png(*command.output, image);
  console.clear_bar();
  if (command.json)
    print(fmt::format("{{\"picture\": {}, \"width\": {}, \"height\": {}}}\n",
                      json_text(command.output->string()), image.width, image.height));
  else if (!command.quiet)
    print(command.output->string() + "\n");
}

void run_inspect(const Command& command) {
  print(command.json ? inspection_json(command.subject) : inspection_text(command.subject));
}

}  // namespace

void run(const Command& command, Console& console) {
  if (command.verb == "build")
    run_build(command, console);
  else if (command.verb == "pile")
    run_pile(command, console);
  else if (command.verb == "tiles")
    run_tiles(command, console);
  else if (command.verb == "render")
    run_render(command, console);
  else if (command.verb == "inspect")
    run_inspect(command);
  else if (command.verb == "completion")
    print(completion_script(describe_command_line(), command.subject));
  else if (command.verb == "man")
    print(manual_page(describe_command_line()));
  else
    print(operations_page());
}

}  // namespace talus::cli
