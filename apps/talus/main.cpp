// The command-line tool: parse, run, and turn what went wrong into one line and an exit status.
#include <exception>
#include <new>
#include <optional>

#include "apps/talus/command.h"
#include "apps/talus/console.h"
#include "apps/talus/verbs.h"
#include "talus/base/error.h"
#include "talus/base/parallel.h"

namespace {

int exit_status(talus::ErrorKind kind) {
  switch (kind) {
    case talus::ErrorKind::job:
      return 1;
    case talus::ErrorKind::usage:
      return 2;
    case talus::ErrorKind::input:
      return 3;
  }
  return 1;
}

void run(int argc, char** argv) {
  const std::optional<talus::cli::Command> command = talus::cli::parse_command_line(argc, argv);
  if (!command) return;
  std::optional<talus::ThreadLimit> threads;
  if (command->threads) threads.emplace(*command->threads);
  talus::cli::Console console(command->quiet);
  const talus::cli::CancelOnInterrupt cancel(console);
  talus::cli::run(*command, console);
}

}  // namespace

int main(int argc, char** argv) {
  talus::cli::occupy_standard_streams();
  try {
    run(argc, argv);
    return 0;
  } catch (const talus::Error& error) {
    talus::cli::print_error(error.what());
    return exit_status(error.kind());
  } catch (const talus::Cancelled& cancelled) {
    talus::cli::print_error(cancelled.what());
  } catch (const std::bad_alloc&) {
    talus::cli::print_error("out of memory; larger stones or a coarser tile set need less");
  } catch (const std::exception& error) {
    talus::cli::print_error(error.what());
  }
  return 1;
}
