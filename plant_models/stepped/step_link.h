#pragma once

// A plant in a process of its own, which is started, stepped and ended here. The plant is not trusted: it may
// crash, hang, answer nonsense. Each costs the link, never the caller: a step takes so long at most as the
// options say, and a link that has failed stays failed.
//
//   auto link = StepLink::start(names, seed, {.arguments = {"/usr/bin/python3", "tank.py"}});
//   link->area().set_actuator(0, 1.0);
//   if (!link->step(10'000'000, 10'000'000)) log(link->trouble());
//
// Threads: `step` and the area belong to the scan's thread: no heap, no lock, two system calls in a step.
// `failed`, `trouble` and the end belong to the thread that started it.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plant_models/stepped/step_area.h"
#include "runtime/ground/process/child_process.h"
#include "runtime/ground/result/result.h"

namespace stepwright::stepped {

struct StepCommand {
  std::vector<std::string> arguments = {};    // the program comes first; without '/' it is looked for in PATH
  std::filesystem::path folder = {};          // its working folder, from which relative programs are taken
  std::chrono::milliseconds patience{1'000};  // for the answer to a step
  std::chrono::milliseconds beginning{30'000};  // until it is ready
  std::vector<double> first_actuators = {};     // what the plant finds there at its beginning; else 0
  std::filesystem::path log = {};  // what it prints is appended to this file; empty: to that of this process
  result::Location where = {};     // for diagnostics
};

enum class LinkFailure : std::uint8_t {
  None,
  Ended,       // its process, or its end of the socket
  Silent,      // no answer in time
  Unfinished,  // it answered before the step was done
  Told,        // it says itself that it cannot go on
  NoNumber,    // a sensor or a value is no finite number
};

// The path of a program as a shell would find it; empty if there is none.
std::string find_program(const std::string& name, const std::filesystem::path& folder);

class StepLink {
 public:
  // Starts the process and waits until it is ready. Fails with R0151, R0153 (it cannot be started, ended or
  // was not ready in time), R0154 (it speaks another version) or R0155 (it says that it cannot run), and
  // leaves no process behind.
  [[nodiscard]] static result::Result<std::unique_ptr<StepLink>> start(const StepNames& names,
                                                                       std::uint64_t seed,
                                                                       const StepCommand& command);
  // Ends the process, and all that it has started.
  ~StepLink();
  StepLink(const StepLink&) = delete;
  StepLink& operator=(const StepLink&) = delete;

  StepArea& area() { return area_; }
  // Has the plant run up to `time_ns`, for `step_ns`. False if the link has failed, now or before.
  bool step(std::int64_t time_ns, std::int64_t step_ns) { return ask(time_ns, step_ns) && finish(); }
  // The two halves of a step; between them the plant runs, and the area is its own.
  bool ask(std::int64_t time_ns, std::int64_t step_ns);
  bool finish();
  // A number of the plant is of no use; the step counts as failed.
  void refuse_number(std::string_view name);

  bool failed() const { return failure_.load(std::memory_order_acquire) != LinkFailure::None; }
  // What has failed, in one sentence, after the process was ended; empty if nothing has.
  std::string trouble();

 private:
  StepLink(StepArea area, int socket, const StepCommand& command);
  [[nodiscard]] result::Result<void> wait_until_ready();
  // The answer within `patience`, or why there is none.
  LinkFailure answer(std::chrono::milliseconds patience);
  bool fail(LinkFailure why);
  // Nothing of it runs then. How it ended.
  std::string end_process(LinkFailure why);

  StepArea area_;
  int socket_;
  StepCommand command_;
  std::optional<process::ChildProcess> process_;
  std::uint64_t steps_ = 0;
  std::atomic<std::int64_t> failed_at_ns_{0};  // simulated
  std::atomic<LinkFailure> failure_{LinkFailure::None};
  std::string end_;       // of the process; empty while it runs
  char number_[64] = {};  // name of what is no number; written before failure_
};

}  // namespace stepwright::stepped
