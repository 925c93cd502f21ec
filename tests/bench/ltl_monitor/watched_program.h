#pragma once

// A program with eight places as inputs, with what watches it, in one of the engines.
//
// Thread rule: one thread.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::bench {

inline constexpr int kPlaces = 8;

enum class EngineKind { Native, Vm };

class WatchedProgram {
 public:
  // Throws std::runtime_error if it does not compile.
  WatchedProgram(EngineKind kind, std::span<const driver::Watcher> watchers);

  // Place k (from 1) is where the vehicle is; 0: at none. `reset`: the first watcher begins anew instead.
  void scan(int place, bool reset) {
    for (int k = 0; k < kPlaces; ++k)
      memory_[places_ + static_cast<std::size_t>(k)] = std::byte(place == k + 1);
    if (reset) memory_[reset_] = std::byte{1};
    for (const bytecode::Invocation& call : calls_) {
      std::uint64_t budget = std::uint64_t{1} << 40;
      trapped_ = trapped_ || engine_->run(call, memory_, budget);
    }
  }
  bool trapped() const { return trapped_; }
  // 0 undecided, 1 TRUE, 2 FALSE.
  int verdict() const { return static_cast<int>(memory_[verdict_]); }

 private:
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  std::vector<std::uint64_t> stack_;
  std::vector<std::byte> quick_code_;
  std::unique_ptr<bytecode::Engine> engine_;
  std::vector<bytecode::Invocation> calls_;
  std::size_t places_ = 0, reset_ = 0, verdict_ = 0;
  bool trapped_ = false;
};

}  // namespace stepwright::bench
