#pragma once

// Runs a piece of work in a process of its own: its memory is measured alone, a limit binds it, and if it
// hangs or crashes the bench goes on and says so.
//
// Thread rule: from a process with one thread only (it forks).
//
//   ChildResult result =
//       run_child({.time = 10s, .memory_mb = 4096}, [](const Send& send) { send("a line"); });

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace stepwright::bench {

struct ChildLimits {
  std::chrono::milliseconds time{0};  // then the child and what it started are ended
  std::size_t memory_mb = 0;          // of address space; 0: no limit
};

// Sends a line, without line ends, to the parent; what was sent before a crash arrives.
using Send = std::function<void(const std::string& line)>;

enum class ChildEnd { Done, OutOfTime, OutOfMemory, Crashed };
const char* to_string(ChildEnd end);

struct ChildResult {
  std::vector<std::string> lines;
  ChildEnd end = ChildEnd::Crashed;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;
  double peak_mb = 0.0;  // of the largest process
};

ChildResult run_child(const ChildLimits& limits, const std::function<void(const Send&)>& body);

// A shell command instead of work of our own; its output is thrown away.
ChildResult run_command(const ChildLimits& limits, const std::string& command);

}  // namespace stepwright::bench
