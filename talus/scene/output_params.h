// What is written of a scene, and for whom.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "talus/base/describe.h"
#include "talus/io/glb_writer.h"
#include "talus/scene/fields.h"

namespace talus {

enum class Format { glb, usda, ply, obj, points, csv };
// Programs whose importers are known; docs/export.md tells what each of them wants and why.
enum class Target { blender, unreal, godot, houdini, isaac };

template <>
inline constexpr auto kEnumNames<Format> = std::to_array<EnumName<Format>>({{Format::glb, "glb"},
                                                                            {Format::usda, "usda"},
                                                                            {Format::ply, "ply"},
                                                                            {Format::obj, "obj"},
                                                                            {Format::points,
                                                                             "points"},
                                                                            {Format::csv, "csv"}});
template <>
inline constexpr auto kEnumNames<Target> =
    std::to_array<EnumName<Target>>({{Target::blender, "blender"},
                                     {Target::unreal, "unreal"},
                                     {Target::godot, "godot"},
                                     {Target::houdini, "houdini"},
                                     {Target::isaac, "isaac"}});
template <>
inline constexpr auto kEnumNames<InstanceMode> =
    std::to_array<EnumName<InstanceMode>>({{InstanceMode::gpu, "gpu"},
                                           {InstanceMode::nodes, "nodes"},
                                           {InstanceMode::flattened, "flattened"}});

struct OutputParams {
  std::optional<Target> target;
  std::optional<std::vector<Format>> formats;
  std::optional<InstanceMode> instances;

  static void describe(auto& p, auto&& field) {
    field(p.target, Field{.name = "for",
                          .help = "the program that is to open the scene; decides formats and "
                                  "instances where they are not given"});
    field(p.formats, Field{.name = "formats",
                           .help = "files written: scene.glb and so on; points and csv are tables "
                                   "of the stones, stones.ply and stones.csv; by default glb"});
    field(p.instances,
          Field{.name = "instances",
                .help = "how scene.glb repeats a stone: with EXT_mesh_gpu_instancing, as nodes "
                        "that share a mesh, or copied out; by default gpu"});
  }
};

// What is given, else what the target wants, else GLB.
std::vector<Format> formats_of(const OutputParams& output);
// Likewise; else `gpu`.
InstanceMode instances_of(const OutputParams& output);

// Objects that the target opens within seconds; nothing if it is given none.
std::optional<std::uint64_t> objects_max(const OutputParams& output);

// "scene.glb", "stones.csv".
std::string_view file_name(Format format);

}  // namespace talus
