// How the library refuses: one exception type, whose kind a front end turns into an exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace talus {

enum class ErrorKind {
  job,    // the job failed: disk full, output unwritable, over a limit
  usage,  // a wrong parameter, recipe or command line
  input,  // an input file missing, unreadable, malformed or unusable
};

// One line: what is wrong, where, and what would be right.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// Thrown through a `Job` that was cancelled; nothing half-written remains.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

inline Error job_error(const std::string& message) { return {ErrorKind::job, message}; }
inline Error usage_error(const std::string& message) { return {ErrorKind::usage, message}; }
inline Error input_error(const std::string& message) { return {ErrorKind::input, message}; }

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace talus

// A broken invariant is our bug: on in debug, tests and sanitizers.
#if defined(TALUS_ENABLE_ASSERTS)
#define TALUS_ASSERT(condition) \
  ((condition) ? void(0) : ::talus::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define TALUS_ASSERT(condition) void(0)
#endif
