// The vertices of dressed meshes as a GLB file keeps them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "talus/io/dressed_mesh.h"
#include "talus/io/glb_file.h"
#include "talus/mesh/instance_table.h"

namespace talus {

// What the numbers in a file are multiplied by. Floats are written as they are; quantized,
// positions are 16-bit counts of `position_step`, directions take a byte a number, and texture
// coordinates are 65 535ths of `texture_span`.
struct VertexFormat {
  bool quantized = false;
  double position_step = 1;
  double texture_span = 1;
};

// The finest format that holds all meshes. The step is a power of two: meshes that meet in a vertex
// meet in the file if they stand a whole number of steps apart.
VertexFormat quantized_format(std::span<const DressedMesh> meshes);

// A position, already in place, as the file's numbers say it.
Vec3f stored_position(const Vec3f& p, const VertexFormat& format);

// Where vertices go: nowhere, or to an instance's place relative to a center. World to glTF.
struct VertexPlace {
  const Instance* instance = nullptr;
  Vec3 center{0};

  Vec3f position(const Vec3f& p) const;
  Vec3f direction(const Vec3f& d) const;
};

// One attribute of a primitive; `rows` has `stride` bytes for each vertex.
struct VertexAttribute {
  const char* name;
  const char* shape;
  int component_type;
  int stride;
  bool normalized;
  std::function<std::vector<std::byte>(const DressedMesh&, const VertexPlace&)> rows;
};

// POSITION, NORMAL, TEXCOORD_0 and COLOR_0, in this order.
std::vector<VertexAttribute> vertex_attributes(const VertexFormat& format);

}  // namespace talus
