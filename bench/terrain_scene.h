// The landscape that benchmarks of terrain share, made once.
#pragma once

#include <map>
#include <utility>

#include "tests/terrain/cave_scene.h"

namespace talus::bench {

constexpr int kSceneX = 1000;
constexpr int kSceneY = 750;

inline const LayeredTerrain& cave_scene(int nx, int ny) {
  static std::map<std::pair<int, int>, LayeredTerrain> scenes;
  const auto found = scenes.find({nx, ny});
  if (found != scenes.end()) return found->second;
  return scenes.emplace(std::pair(nx, ny), test::cave_scene(nx, ny)).first->second;
}

}  // namespace talus::bench
