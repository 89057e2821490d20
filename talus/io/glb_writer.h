// Scenes as GLB, for Blender, engines and browsers.
#pragma once

#include <cstdint>
#include <filesystem>

#include "talus/base/job.h"
#include "talus/io/scene_view.h"

namespace talus {

enum class InstanceMode {
  gpu,        // EXT_mesh_gpu_instancing, quantized: smallest and fastest, where it is known
  nodes,      // one node for each stone, sharing meshes: read everywhere
  flattened,  // a few large meshes
};

struct GlbParams {
  InstanceMode instances = InstanceMode::gpu;
  std::uint64_t seed = 1;  // of the stone material's pattern and the stones' tints
};

struct GlbStats {
  std::uint64_t bytes = 0;
  std::uint64_t nodes = 0;
  std::uint64_t meshes = 0;
  std::uint64_t vertices = 0;   // stored, texture seams split
  std::uint64_t triangles = 0;  // stored
};

// Writes the scene as glTF 2.0 in one file. World (x, y, z) becomes (x, z, -y), y up.
//
// The nodes `ground` and `water` stand at their meshes' origins (double). Ground with shares has
// vertex colors, the materials' colors blended by them, and the shares themselves in the attributes
// _MATERIALS_0 and _MATERIALS_1; the mesh's extras name the eight materials in order. Water is
// translucent.
//
// The node `stones` stands at the center of the stones, all below it is relative to that and keeps
// float precision. Its children:
//   gpu        cells `stones/<cell>` of neighboring stones, for culling, and below them
//              `stones/<cell>/<k>` for prototype k with the instance attribute TRANSLATION;
//              ROTATION and SCALE stand on the node if its instances share them, else are
//              attributes too
//   nodes      `stones/<k>/<i>` for instance i of prototype k, meshes shared
//   flattened  `stones/<k>`, runs of instances in the table's order, at most 4 million vertices
// The scene's extras say which mode it is and, if there is one, the height of the plane.
// Meshes are named `stones/<k>`. Stones carry positions, normals, box-projected texture coordinates
// and a tint; vertices are split at texture seams, where positions stay bit-equal. The material is
// seamless procedural stone; tangents are left to the reader.
//
// With `gpu` numbers of stones are quantized (KHR_mesh_quantization): positions to a power of two,
// at least a 32 767th of how far the meshes reach, which the extras call `position_step`; normals
// to a byte a number; texture coordinates to 16 bits, scaled up by KHR_texture_transform. Meshes
// that meet in a vertex still do where they stand a whole number of those steps apart.
//
// The file is a function of scene and parameters alone, and appears complete or not at all. Throws
// `Error` (job) if it cannot be written or would pass 4 GiB, the limit of the format.
GlbStats write_glb(const std::filesystem::path& path, const SceneView& scene,
                   const GlbParams& params = {}, Job* job = nullptr);

}  // namespace talus
