#pragma once

// A process that stands over a program and ends with everything that the program has started: also what has a
// session of its own, or whose parent is gone (prctl(2), PR_SET_CHILD_SUBREAPER).
//
// Threads: between fork and exec of a process with any number of them; calls of the system only.

#include <signal.h>

namespace stepwright::process {

// To the subreaper: the program is killed. SIGTERM goes on to the program, which is killed 2 s later. SIGKILL
// would leave behind what the program has started, never the program.
inline constexpr int kKillProgram = SIGUSR1;

// Forks. Returns in the process that is to become the program, in a process group of its own. The other one
// keeps the standard streams only, and ends as the program did: with its exit code, or by its signal, as soon
// as all that it has started is killed. Requires that all signals are blocked.
void stand_over_program();

}  // namespace stepwright::process
