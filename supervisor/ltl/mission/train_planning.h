#pragma once

// Plans of a cell's train, as programs: from where it stands and from what of its task is done already to a
// container that the runtime runs; the one that brings it to rest; the one that only looks.
//
// Threads: one at a time. Example:
//   auto planning = TrainPlanning::open(options);
//   auto prepared = planning->plan({.task = planning->first_task(), .standing = start});
//   controller.download(prepared->container);

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "supervisor/ltl/program/train_program.h"

namespace stepwright::ltl {

struct TrainPlanningOptions {
  Problem problem;          // the floor, the train as it is, where the file has it stand, the task
  double margin_m = 0.12;   // kept around each link, for what driving deviates
  double lock_share = 0.8;  // of the full lock: the rest is for the controller
  double hitch_rad = 1.1;   // plans bend no hitch further; the program's fold_rad is the interlock beyond it
  TrainTerminals terminals;
  TrainProgramOptions program;
  std::uint64_t seed = 1;
  double most_s = 10.0;  // until there is a plan
  // After it for a shorter one, by rounds: the same on every machine.
  std::size_t shorten_rounds = 0;
  std::vector<driver::Watcher> watchers{};  // compiled with every program
  std::size_t threads = 0;                  // of the planner; 0: as many as the machine has
};

// A task that can be planned, and its monitor.
struct TrainTask {
  std::string text;
  Formula formula;
  Automaton monitor;

  std::uint32_t begins() const { return monitor.initial; }
};

struct TrainRequest {
  const TrainTask* task = nullptr;
  std::uint32_t state = 0;  // of its monitor
  TrainState standing{};    // at rest
  std::size_t trailers = 0;
  std::vector<Area> blocked = {};  // what stands on the floor besides
  double known_m = 0.0;            // see TrainProgramOptions
  std::uint32_t reset = 0;
  const std::atomic<bool>* cancel = nullptr;
};

struct PreparedTrain {
  TrainProgram program;
  std::vector<std::byte> container;
  TrainModel train;  // as it was planned for, without the margin
  TrainWay way;
  TrainWatch watch;
  PlanAnswer answer;  // of a drive
};

class TrainPlanning {
 public:
  // What is wrong with the floor, the train or the task (supervisor/doc/ltl.md, Codes).
  [[nodiscard]] static result::Result<TrainPlanning> open(TrainPlanningOptions options);

  // L0001 to L0015, L0311, L0312; L0503: a task with X, whose letters a scan does not count.
  [[nodiscard]] result::Result<TrainTask> task(const std::string& text) const;
  const TrainTask& first_task() const { return *first_; }
  const TrainPlanningOptions& options() const { return options_; }
  // The floor without what stands on it besides.
  const RegionMap& regions() const { return *regions_; }

  // Codes of plan_train and train_program.
  [[nodiscard]] result::Result<PreparedTrain> plan(const TrainRequest& request) const;
  // Along the way of what is driven, until it stands; the monitor goes on from `state`.
  [[nodiscard]] result::Result<PreparedTrain> halt(const PreparedTrain& driven, std::uint32_t state) const;
  // Brakes on. Of the trailers nothing is known yet.
  [[nodiscard]] result::Result<PreparedTrain> observe(const TrainTask& task, std::uint32_t state,
                                                      std::uint32_t reset) const;

 private:
  explicit TrainPlanning(TrainPlanningOptions options) : options_(std::move(options)) {}
  [[nodiscard]] result::Result<PlanAnswer> answer(const TrainRequest& request, Problem& problem) const;
  [[nodiscard]] result::Result<void> compile(TrainProgramKind kind, double known_m, std::uint32_t reset,
                                             PreparedTrain& prepared) const;

  TrainPlanningOptions options_;
  std::optional<RegionMap> regions_;
  std::optional<TrainTask> first_;
};

}  // namespace stepwright::ltl
