// Smoothing samples of a grid over their neighbors.
#pragma once

#include <vector>

#include "talus/base/vec.h"

namespace talus {

// Replaces each sample by the sum over itself and its 26 neighbors with weights (1 2 1)^3: 8 for
// itself, 4, 2 and 1 across faces, edges and corners. Sample (x, y, z) is element
// x + size.x (y + size.y z). Samples beyond the grid count 0 where those on its border are 0; those
// on a border that is not come out meaningless, but always the same.
template <class T>
void blur(const Int3& size, std::vector<T>& values, std::vector<T>& scratch) {
  scratch.resize(values.size());
  const auto layer = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  for (const std::size_t stride : {std::size_t{1}, static_cast<std::size_t>(size.x), layer}) {
    const T* const in = values.data();
    T* const out = scratch.data();
    const std::size_t end = values.size() - stride;
    for (std::size_t i = 0; i < stride; ++i) out[i] = static_cast<T>(2 * in[i] + in[i + stride]);
    for (std::size_t i = stride; i < end; ++i)
      out[i] = static_cast<T>(in[i - stride] + 2 * in[i] + in[i + stride]);
    for (std::size_t i = end; i < end + stride; ++i)
      out[i] = static_cast<T>(in[i - stride] + 2 * in[i]);
    values.swap(scratch);
  }
}

}  // namespace talus
