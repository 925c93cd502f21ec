#pragma once

// Configuration of a runtime: the part of a cell's that concerns the scan. Plain data; any thread.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/host/engine_choice.h"
#include "runtime/host/safety_config.h"
#include "runtime/host/task_settings.h"
#include "runtime/record/retain_manager.h"

namespace stepwright::host {

enum class ClockMode : std::uint8_t {
  Simulated,  // the scan clock advances with the scans, as fast as `speed` allows
  Real,       // the scan waits for the machine's clock
};

enum class LostSupervisor : std::uint8_t {
  Continue,  // the program goes on; barriers no longer hold
  Safe,      // the program is stopped, outputs go to their safe state
};

// A fault of the simulated plant that happens by itself, before the first scan at or after its instant.
struct ScheduledFault {
  std::int64_t at_ns = 0;
  std::string name;
  double value = 0.0;
};

struct HostConfig {
  ClockMode clock = ClockMode::Simulated;
  EngineKind engine = EngineKind::Auto;
  double speed = 0.0;                          // simulated: times real time; 0 = as fast as possible
  std::int64_t idle_interval_ns = 10'000'000;  // real clock: period of the I/O while no program runs
  std::size_t input_bytes = 64;                // of the areas that the I/O driver serves
  std::size_t output_bytes = 64;
  SafetyConfig safety;
  LostSupervisor on_lost_supervisor = LostSupervisor::Continue;
  std::vector<ScheduledFault> faults;
  std::vector<TaskSettings> tasks;     // by name; a task without an entry has the defaults
  int cpu = -1;                        // real clock: the only processor of the scan; -1: any
  std::size_t memory_limit_bytes = 0;  // of this process, below the limits of the system; 0: none of its own
  std::uint32_t change_trial_scans = 10;  // in which a trap of a changed program brings the old one back
  record::RetainConfig retain;            // without a store retained values end with the process
};

}  // namespace stepwright::host
