#pragma once

// A program with eight places as inputs, with what watches it, in one of the engines.
//
// Thread rule: one thread.

#include <span>
#include <string>

#include "tests/support/engine_program/engine_program.h"

namespace stepwright::bench {

using support::compile_st;
using support::EngineKind;
using support::EngineProgram;

inline constexpr int kPlaces = 8;

class WatchedProgram {
 public:
  // Throws std::runtime_error if it does not compile.
  WatchedProgram(EngineKind kind, std::span<const driver::Watcher> watchers);

  // Place k (from 1) is where the vehicle is; 0: at none. `reset`: the first watcher begins anew instead.
  void scan(int place, bool reset) {
    const std::span<std::byte> memory = program_.memory();
    for (int k = 0; k < kPlaces; ++k)
      memory[places_ + static_cast<std::size_t>(k)] = std::byte(place == k + 1);
    if (reset) memory[reset_] = std::byte{1};
    (void)program_.scan();
  }
  bool trapped() const { return program_.trapped(); }
  // 0 undecided, 1 TRUE, 2 FALSE.
  int verdict() const { return static_cast<int>(program_.memory()[verdict_]); }

 private:
  EngineProgram program_;
  std::size_t places_ = 0, reset_ = 0, verdict_ = 0;
};

}  // namespace stepwright::bench
