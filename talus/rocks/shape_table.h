// What stones of one form share.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "talus/mesh/triangle_mesh.h"

namespace talus::rocks {

// The surface of a stone around the middle of its solid; lengths in cells.
struct Shape {
  std::shared_ptr<const TriangleMesh> mesh;
  double volume = 0;
  double radius = 0;  // of the smallest ball around the middle that holds the mesh
  Box3 box;
};

// Shapes by the digest of the samples they are made from. Threads may share it: equal samples make
// equal shapes, so it does not matter which of two comes first.
class ShapeTable {
 public:
  // The shape with this digest, made by `make()` unless it is there.
  Shape get(const std::string& digest, auto&& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = shapes_.find(digest); found != shapes_.end()) return found->second;
    }
    Shape made = make();
    const std::lock_guard lock(mutex_);
    return shapes_.try_emplace(digest, std::move(made)).first->second;
  }
  std::size_t size() const { return shapes_.size(); }

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, Shape> shapes_;
};

}  // namespace talus::rocks
