#pragma once

// A process as others find it again, also from another PID namespace, where it has another number: what
// stands in the header of the area beside what it holds.
//
// Threads: any. `own` is two system calls and is asked once; `open_process` looks through /proc where the
// number is of another namespace, and so is not for a scan.

#include <cstdint>

namespace stepwright::io_memory {

struct ProcessMark {
  std::uint32_t pid = 0;    // in its namespace
  std::uint64_t space = 0;  // the namespace (its inode); 0: not known, so that of whoever reads it

  static ProcessMark own();
};

// A descriptor of the process (pidfd), which the caller closes; -1 if there is none that this process can
// see. Of a number that was given again it may be the wrong one: who asks looks afterwards whether the mark
// still holds.
int open_process(const ProcessMark& mark);

// SIGKILL. False if this user may not.
bool kill_process(int descriptor);

}  // namespace stepwright::io_memory
