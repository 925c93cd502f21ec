#pragma once

// A command that goes on without its terminal, once what it was started for is done.
//
//   Detached detached;
//   if (auto exit = detached.leave(log); exit && *exit) return **exit;    // in the process that was started
//   ...                                                                  // in the one that goes on
//   detached.up(ExitCode::Done);
//
// Threads: one, and none may have been started.

#include <filesystem>
#include <optional>

#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"

namespace stepwright::up {

class Detached {
 public:
  Detached() = default;
  ~Detached();
  Detached(const Detached&) = delete;
  Detached& operator=(const Detached&) = delete;

  // In a process of its own, with `log` for its streams, it returns nothing. In the process that was started
  // it waits until the other one is up or has ended, prints what stands in the log, and returns the exit code
  // to end with. The log has room for what is to be told before that, and the file system for the cell's
  // record. Fails with M0014; M0022: the file system has no such room.
  [[nodiscard]] result::Result<std::optional<int>> leave(const std::filesystem::path& log);
  // Ends the process that waits, with this exit code; does nothing where nobody waits.
  void up(result::ExitCode exit);

 private:
  int waiter_ = -1;  // where the other process reads
};

}  // namespace stepwright::up
