#include "apps/talus/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>

namespace talus::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kRedrawInterval = std::chrono::milliseconds(50);
constexpr auto kStageInterval = std::chrono::milliseconds(500);

std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

// Whatever happens to standard error, the job goes on.
void write_error(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

// A signal handler has no argument: this is the one thing it may reach.
std::atomic<Job*> interrupted_job = nullptr;
static_assert(std::atomic<Job*>::is_always_lock_free);

void on_signal(int signal) {
  Job* const job = interrupted_job.exchange(nullptr);
  if (job) {
    job->cancel();
  } else {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

Console::Console(bool quiet) : bar_(!quiet && isatty(STDERR_FILENO) != 0) {}

void Console::progress(std::string_view stage, double fraction) {
  if (!bar_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  // Of stages that run at the same time another one shows once the last has been silent a while.
  if (now - drawn_ < (stage == stage_ ? kRedrawInterval : kStageInterval)) return;
  drawn_ = now;
  stage_ = stage;

  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * kBarWidth);
  std::string line =
      fmt::format("{:<24.24} [{:<{}}] {:3.0f} %", stage,
                  std::string(static_cast<std::size_t>(filled), '#'), kBarWidth, 100 * done);
  if (line == line_) return;
  line_ = std::move(line);
  write_error("\r" + line_);
  shown_ = true;
}

void Console::warn(std::string_view message) {
  const std::lock_guard lock(mutex_);
  erase();
  write_error(fmt::format("talus: warning: {}\n", one_line(message)));
}

void Console::clear_bar() {
  const std::lock_guard lock(mutex_);
  erase();
}

void Console::erase() {
  if (!shown_) return;
  write_error("\r\033[K");
  std::fflush(stderr);
  line_.clear();
  shown_ = false;
}

void print_error(std::string_view message) {
  write_error(fmt::format("talus: error: {}\n", one_line(message)));
}

void occupy_standard_streams() {
  int descriptor = 0;
  do descriptor = open("/dev/null", O_RDONLY | O_NOCTTY);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor >= 0) close(descriptor);
}

CancelOnInterrupt::CancelOnInterrupt(Job& job) {
  interrupted_job = &job;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

CancelOnInterrupt::~CancelOnInterrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  interrupted_job = nullptr;
}

}  // namespace talus::cli
