#pragma once

// Interface of the routes to the cell for a program that takes over from the one that runs
// (runtime/doc/online_change.md). The program implements it over Fast DDS and with the compiler, tests with a
// cell of their own.
//
// Threads: every function from any; `change` blocks until the runtime has answered. Fails with D0001 where
// nobody answers, D0002 where the program is just changing, and with what the runtime refuses.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hmi_web/api/route.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

// The program that is loaded, and what it has in its variables.
struct LoadedNow {
  std::string digest;
  std::shared_ptr<const std::vector<std::byte>> container;
  bool running = false;
  std::vector<std::byte> image = {};  // of this program; empty: none has arrived
};

// Summary of an online change, by the runtime.
struct Takeover {
  std::uint32_t carried = 0;
  std::uint32_t initialised = 0;
  std::uint32_t dropped = 0;
  std::uint32_t retyped = 0;
  std::uint32_t dropped_forces = 0;
  double pause_us = 0;
  std::vector<std::string> notes = {};  // with the first names of each kind
};

// How the newest change made here goes on.
struct Trial {
  enum class State {
    None,        // there was no change
    Running,     // the old program stands by
    Kept,        // passed
    RolledBack,  // the runtime went back to the old program
    Ended,       // by something else: a stop, another download, a runtime that is gone
  };
  State state = State::None;
  std::uint32_t scan = 0;  // of `scans`
  std::uint32_t scans = 0;
  std::string why = {};  // of RolledBack and Ended
};

struct Compiled {
  std::vector<std::byte> container;
  result::Diagnostics warnings;
};

using SourceTexts = std::map<std::string, std::string, std::less<>>;  // by the names of their files

class CellChange {
 public:
  virtual ~CellChange() = default;

  [[nodiscard]] virtual result::Result<LoadedNow> loaded() = 0;
  // Why nobody may change the program now: a supervisor acts in this runtime. Empty: somebody may.
  virtual std::string engaged() = 0;
  // The container as this cell's controller takes it: one behind a gateway keeps no sources.
  virtual std::vector<std::byte> fitted(std::vector<std::byte> container) = 0;
  // An online change; the charts begin anew or go on.
  [[nodiscard]] virtual result::Result<Takeover> change(std::span<const std::byte> container,
                                                        bool restart_charts) = 0;
  virtual Trial trial() = 0;
  // ST and PLCopen XML. Fails with what the compiler says.
  [[nodiscard]] virtual result::Result<Compiled> compile(const SourceTexts& sources) = 0;
  // As GET /api/program says it of the program that runs.
  virtual Answer sources(const std::string& digest, std::span<const std::byte> container) = 0;
};

}  // namespace stepwright::api
