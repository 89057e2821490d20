// What a person sees while a job runs, and how they stop it.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "talus/base/job.h"

namespace talus::cli {

// Shows a progress bar on standard error if that is a terminal, and warnings in any case.
class Console final : public Job {
 public:
  // `quiet` leaves the bar out.
  explicit Console(bool quiet);
  ~Console() override { clear_bar(); }

  void progress(std::string_view stage, double fraction) override;
  void warn(std::string_view message) override;
  // Takes the bar away, so that other text can follow.
  void clear_bar();

 private:
  void erase();

  std::mutex mutex_;
  const bool bar_;
  bool shown_ = false;
  std::string stage_;
  std::string line_;
  std::chrono::steady_clock::time_point drawn_{};
};

// "talus: error: <message>" on standard error, always one line. If that cannot be written, the exit
// status alone must tell.
void print_error(std::string_view message);

// Puts something unwritable where the caller closed standard input, output or error, so that no
// file opened later takes its number and the text meant for it.
void occupy_standard_streams();

// While alive, the first Ctrl-C (or termination signal) cancels the job; the second ends the
// program at once. One at a time.
class CancelOnInterrupt {
 public:
  explicit CancelOnInterrupt(Job& job);
  ~CancelOnInterrupt();
  CancelOnInterrupt(const CancelOnInterrupt&) = delete;
  CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
};

}  // namespace talus::cli
