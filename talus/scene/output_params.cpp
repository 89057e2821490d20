#include "talus/scene/output_params.h"

#include <algorithm>

namespace talus {
namespace {

struct TargetNeeds {
  std::vector<Format> formats;
  InstanceMode instances;
  std::optional<std::uint64_t> objects_max;
};

TargetNeeds needs_of(Target target) {
  switch (target) {
    case Target::blender:
      return {{Format::glb}, InstanceMode::nodes, 50'000};
    case Target::godot:
      return {{Format::glb}, InstanceMode::nodes, 20'000};
    case Target::unreal:
    case Target::houdini:
    case Target::isaac:
      return {{Format::usda}, InstanceMode::gpu, std::nullopt};
  }
  return {};
}

}  // namespace

std::vector<Format> formats_of(const OutputParams& output) {
  if (output.formats) return *output.formats;
  return output.target ? needs_of(*output.target).formats : std::vector{Format::glb};
}

InstanceMode instances_of(const OutputParams& output) {
  if (output.instances) return *output.instances;
  return output.target ? needs_of(*output.target).instances : InstanceMode::gpu;
}

std::optional<std::uint64_t> objects_max(const OutputParams& output) {
  const std::vector<Format> formats = formats_of(output);
  const bool has_objects = instances_of(output) == InstanceMode::nodes &&
                           std::find(formats.begin(), formats.end(), Format::glb) != formats.end();
  if (!output.target || !has_objects) return std::nullopt;
  return needs_of(*output.target).objects_max;
}

std::string_view file_name(Format format) {
  switch (format) {
    case Format::glb:
      return "scene.glb";
    case Format::usda:
      return "scene.usda";
    case Format::ply:
      return "scene.ply";
    case Format::obj:
      return "scene.obj";
    case Format::points:
      return "stones.ply";
    case Format::csv:
      return "stones.csv";
  }
  return "";
}

}  // namespace talus
