// What every benchmark prints beside its time.
#pragma once

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>

namespace talus::bench {

// Times the iterations itself, to print the mean as a share of a bound: below 1 the promise holds.
class Bound {
 public:
  Bound(benchmark::State& state, double seconds) : state_(state), bound_(seconds) {}
  ~Bound() {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    state_.counters["of_bound"] =
        elapsed.count() / static_cast<double>(state_.iterations()) / bound_;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state_.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
  }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;

 private:
  benchmark::State& state_;
  double bound_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace talus::bench
