// Parallel loops. Each iteration writes its own slots, so results do not depend on threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace talus {

// Calls `body(i)` once for each i in [0, count). An exception from a body stops the loop and is
// rethrown here. `grain` consecutive iterations share one task.
template <class Body>
void parallel_for(std::size_t count, Body&& body, std::size_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

// While alive, loops use at most `threads` threads (at least 1).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 static_cast<std::size_t>(threads < 1 ? 1 : threads)) {}

 private:
  tbb::global_control control_;
};

}  // namespace talus
