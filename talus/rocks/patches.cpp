#include "talus/rocks/patches.h"

#include <numeric>

namespace talus::rocks {
namespace {

// Stable, by key(item) < keys.
template <class T>
void counting_sort(std::vector<T>& items, std::size_t keys, auto&& key) {
  std::vector<std::uint32_t> next(keys + 1, 0);
  for (const T& item : items) ++next[key(item) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<T> sorted(items.size());
  for (const T& item : items) sorted[next[key(item)]++] = item;
  items.swap(sorted);
}

// Every patch from either side, for those parties that are candidates.
void list_sides(std::span<const SharedFace> faces, std::size_t candidates, BlockPatches& result) {
  struct Seen {
    std::uint32_t from;
    BlockPatches::Side side;
  };
  std::vector<Seen> seen;
  for (std::uint32_t p = 0; p < result.patches.size(); ++p) {
    const SharedFace& face = faces[result.patches[p].first_face];
    if (face.first < candidates) seen.push_back({face.first, {p, 1}});
    if (face.second < candidates) seen.push_back({face.second, {p, 0}});
  }
  counting_sort(seen, candidates, [](const Seen& s) { return s.from; });
  result.first.assign(candidates + 1, 0);
  for (const Seen& s : seen) {
    ++result.first[s.from + 1];
    result.sides.push_back(s.side);
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
}

}  // namespace

BlockPatches find_patches(std::span<const Party> parties, std::size_t candidates,
                          std::vector<SharedFace>& faces) {
  counting_sort(faces, parties.size(), [](const SharedFace& f) { return f.second; });
  counting_sort(faces, parties.size(), [](const SharedFace& f) { return f.first; });

  BlockPatches result;
  for (auto& along : result.faces) along.reserve(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const SharedFace& face = faces[i];
    if (i == 0 || face.first != faces[i - 1].first || face.second != faces[i - 1].second)
      result.patches.push_back(
          {.parties = {parties[face.first], parties[face.second]}, .first_face = i});
    Patch& patch = result.patches.back();
    patch.end_face = i + 1;
    patch.sum += face.middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result.faces[axis].push_back(face.middle[static_cast<int>(axis)]);
  }
  list_sides(faces, candidates, result);
  return result;
}

}  // namespace talus::rocks
