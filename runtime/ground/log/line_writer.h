#pragma once

// Writes lines to a pipe, a terminal or a file on a thread of its own, so that nobody waits for a reader that
// does not read or a disk that does not write. In ordinary times a line is written when `put` returns: what
// explains a crash is not lost in it. Whoever has waited in vain for kPatience does not wait again before
// everything is written; what does not fit into the queue meanwhile is lost and counted.
//
// Threads: one at a time for each function. Nothing here fails a caller: a target that cannot be written
// costs the line. Without a thread (the system gives none) lines are written by the caller.
//
//   LineWriter writer;
//   writer.set_target({.write = ..., .ready = ...});
//   writer.put("...");

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace stepwright::log {

// Where lines go. Both are called with no lock held.
struct LineTarget {
  std::function<void(const std::string& line)> write;
  std::function<bool()> ready = [] { return true; };  // whether a line can be written at once
};

class LineWriter {
 public:
  static constexpr std::size_t kMaxLines = 1'024;
  static constexpr std::size_t kMaxBytes = 1u << 20;
  static constexpr std::chrono::milliseconds kPatience{200};
  // At the end, for what is still to be written.
  static constexpr std::chrono::milliseconds kLastPatience{1'000};

  LineWriter();
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  // From the next line on.
  void set_target(LineTarget target);
  void put(std::string line);
  // Lines that were lost since the last call, once there is room again.
  std::uint64_t take_lost();

 private:
  struct State;
  std::shared_ptr<State> state_;  // a thread that never comes back from the system keeps it
  std::thread thread_;
};

}  // namespace stepwright::log
