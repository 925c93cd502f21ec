#pragma once

// Makes the stacks of threads small. Locked memory (real time) is resident to the last page, and a thread's
// stack is 8 MiB by default: most of a runtime's memory, where its threads need a few pages.
//
// Threads: call it before the first one is created; it holds for all that come later.

#include <cstddef>

namespace stepwright::host {

inline constexpr std::size_t kThreadStackBytes = 512u << 10;

// False if the system refuses; threads then have the system's stacks.
bool limit_thread_stacks();

}  // namespace stepwright::host
