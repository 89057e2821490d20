// What a long operation tells its caller, and how the caller stops it.
#pragma once

#include <atomic>
#include <string_view>

#include "talus/base/error.h"

namespace talus {

// Derive to show progress and warnings. Operations take a `Job*` that may be null. The virtual
// functions may be called from any thread; `cancel` is safe in a signal handler.
class Job {
 public:
  virtual ~Job() = default;

  // `fraction` in [0, 1] of the named stage is done.
  virtual void progress(std::string_view /*stage*/, double /*fraction*/) {}
  // Something a user should know although the job goes on.
  virtual void warn(std::string_view /*message*/) {}

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
};

// Throws `Cancelled` if the job was cancelled.
inline void check_cancelled(const Job* job) {
  if (job && job->cancelled()) throw Cancelled();
}
inline void report_progress(Job* job, std::string_view stage, double fraction) {
  if (!job) return;
  check_cancelled(job);
  job->progress(stage, fraction);
}
inline void warn(Job* job, std::string_view message) {
  if (job) job->warn(message);
}

}  // namespace talus
