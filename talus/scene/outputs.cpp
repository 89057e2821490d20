#include "talus/scene/outputs.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "talus/io/atomic_file.h"
#include "talus/io/glb_writer.h"
#include "talus/io/mesh_writer.h"
#include "talus/io/stone_table_writer.h"
#include "talus/io/usda_writer.h"

namespace talus {

namespace fs = std::filesystem;

namespace {

void warn_of_many_objects(const OutputParams& output, std::uint64_t stones, Job* job) {
  const std::optional<std::uint64_t> most = objects_max(output);
  if (!most || stones <= *most) return;
  warn(job, fmt::format("{0} stones are more objects than {1} opens in a few seconds "
                        "({2}); docs/export.md tells what else {1} reads",
                        stones, enum_name(*output.target), *most));
}

}  // namespace

void check_writable_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) throw job_error(folder.string() + ": no such folder; make it first");
  if (!fs::is_directory(status))
    throw job_error(folder.string() + ": this is a file; name a folder to write into");
  // Only trying tells: permissions do not bind root, and some file systems take no files.
  std::string attempt = (folder / ".talus_XXXXXX").string();
  const int descriptor = mkstemp(attempt.data());
  if (descriptor < 0)
    throw job_error(
        fmt::format("{}: no file can be made there: {}; name a folder that can be "
                    "written",
                    folder.string(), std::generic_category().message(errno)));
  close(descriptor);
  unlink(attempt.c_str());
}

void check_writable_file(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) throw job_error(file.string() + ": this is a folder; name a file");
  if (!fs::status_known(status)) throw job_error(file.string() + ": " + error.message());
  check_writable_folder(file.has_parent_path() ? file.parent_path() : ".");
}

OutputFolder::OutputFolder(fs::path path) : path_((path / "").parent_path()) {
  std::error_code error;
  for (fs::path p = path_; !p.empty() && !fs::exists(p, error); p = p.parent_path())
    made_.push_back(p);
  fs::create_directories(path_, error);
  if (error)
    throw job_error(
        fmt::format("{}: {}; name a folder that can be written", path_.string(), error.message()));
  check_writable_folder(path_);
}

OutputFolder::~OutputFolder() {
  // Removing fails, as it should, where files have come in.
  std::error_code error;
  for (const fs::path& folder : made_)
    if (!fs::remove(folder, error)) break;
}

std::vector<fs::path> write_scene(const BuildResult& result, const fs::path& folder, Job* job) {
  const OutputParams& output = result.recipe.output;
  const std::uint64_t seed = result.recipe.seed;
  SceneView scene{.stones = result.piles.empty() ? nullptr : &result.stones, .plane = result.plane};
  if (const auto& terrain = result.terrain) {
    scene.ground = {&terrain->ground.mesh, terrain->ground.origin};
    if (!terrain->water.triangles.empty()) scene.water = {&terrain->water, terrain->ground.origin};
  }
  warn_of_many_objects(output, result.stones.instances.size(), job);
  std::vector<fs::path> files;
  for (const Format format : formats_of(output)) {
    const fs::path file = folder / file_name(format);
    switch (format) {
      case Format::glb:
        write_glb(file, scene, {.instances = instances_of(output), .seed = seed}, job);
        break;
      case Format::usda:
        write_usda(file, scene, seed, job);
        break;
      case Format::ply:
        write_ply(file, scene, job);
        break;
      case Format::obj:
        write_obj(file, scene, job);
        break;
      case Format::points:
        write_points(file, result.stones, job);
        break;
      case Format::csv:
        write_csv(file, result.stones, job);
        break;
    }
    files.push_back(file);
  }
  return files;
}

void write_text(const fs::path& file, std::string_view text) {
  AtomicFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace talus
