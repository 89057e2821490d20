#include "talus/base/stage.h"

#include <sys/resource.h>

#include <chrono>

namespace talus {
namespace {

double wall_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

rusage process_usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

StageTimer::StageTimer() : wall_s_(wall_seconds()), cpu_s_(cpu_seconds(process_usage())) {}

Stage StageTimer::stop(std::string name, bool cached) const {
  const rusage usage = process_usage();
  return {.name = std::move(name),
          .wall_s = wall_seconds() - wall_s_,
          .cpu_s = cpu_seconds(usage) - cpu_s_,
          .peak_mb = static_cast<double>(usage.ru_maxrss) / 1024,
          .cached = cached,
          .phases = {}};
}

}  // namespace talus
