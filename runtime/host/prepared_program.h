#pragma once

// A verified program with all the memory that running it takes: image, stack, engine, scan, step watch, event
// ring. Built by the thread that prepares programs; handed to the scan thread, which runs it until the next
// one comes; destroyed by the preparing thread again.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/area_driver.h"
#include "runtime/host/bool_bytes.h"
#include "runtime/host/engine_choice.h"
#include "runtime/host/event_ring.h"
#include "runtime/host/host_config.h"
#include "runtime/host/merge_map.h"
#include "runtime/host/scan_monitor.h"
#include "runtime/host/seq_cell.h"
#include "runtime/host/step_watch.h"
#include "runtime/host/task_plan.h"
#include "runtime/host/task_threads.h"
#include "runtime/image/process_image.h"
#include "runtime/record/retained_values.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::host {

class PreparedProgram {
 public:
  // Environment of a program: I/O, clock, configuration, monitor.
  struct Environment {
    AreaDriver& io;
    scan::Clock& clock;
    const HostConfig& config;
    ThreadLiveness* liveness = nullptr;  // of the scan thread; null: nobody looks at it
    ScanMonitor* monitor = nullptr;      // looks at the threads of other tasks; null: nobody does
    std::int64_t clock_origin_ns = 0;    // what the clock shows at scan time 0
    std::size_t plant_values = 0;
    std::function<void()> task_failed = [] {};  // see WorkerSetup::failed
  };

  // Verifies the container and takes its memory and threads. Fails with the diagnostics of the verifier, with
  // R0080 where the program needs more than a cell or a message can carry, with R0021 where its values cannot
  // all be told apart (reader::visit_values), with R0010 (see make_engine), with R0071 where the system gives
  // no threads for its tasks, or with R0076 where it takes more memory than is free within the limit of the
  // process. Throws std::bad_alloc where the system gives no memory after all. What is passed by reference
  // must outlive the program.
  [[nodiscard]] static result::Result<std::unique_ptr<PreparedProgram>> create(
      std::vector<std::byte> container, std::string digest, const Environment& environment);

  PreparedProgram(const PreparedProgram&) = delete;
  PreparedProgram& operator=(const PreparedProgram&) = delete;

  const std::string& digest() const { return digest_; }
  const reader::LoadedProgram& loaded() const { return loaded_; }

  // Its retained values, with their buffers; set before it is handed over.
  record::RetainChannel& retained() const { return *retained_; }
  void set_retained(std::shared_ptr<record::RetainChannel> retained) { retained_ = std::move(retained); }

  // Scan thread only.
  // Before its first scan: what an online change is about to write comes near the processor.
  void warm();
  image::ProcessImage& image() { return image_; }
  scan::ScanCycle& cycle() { return cycle_; }
  StepWatch& steps() { return steps_; }
  const BoolBytes& bools() const { return machine_.bools; }
  TaskThreads& task_threads() { return *tasks_; }
  // Publishes how punctual the scan thread's own tasks are.
  void publish_timings();
  // Pushed by the scan thread, popped by the service thread.
  EventRing& events() { return events_; }

  // Any thread.
  const TaskPlan& tasks() const { return machine_.plan; }
  scan::TaskTiming timing(std::uint32_t task) const { return published_[task].load(); }

 private:
  struct Machine {
    std::unique_ptr<bytecode::Engine> engine;
    std::vector<std::unique_ptr<bytecode::Engine>> engines;  // of the tasks that have threads of their own
    BoolBytes bools;
    MergeMap merge_map;
    TaskPlan plan;
    std::vector<std::byte> safe_outputs;
  };
  PreparedProgram(reader::LoadedProgram loaded, Machine machine, std::string digest,
                  const Environment& environment);

  std::string digest_;
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  Machine machine_;                        // before the cycle, which refers to it
  std::vector<scan::TaskTiming> timings_;  // of the tasks that the scan thread runs; by index
  std::vector<SeqCell<scan::TaskTiming>> published_;
  image::ProcessImage image_;
  scan::ScanCycle cycle_;
  StepWatch steps_;
  EventRing events_;
  std::unique_ptr<TaskThreads> tasks_;               // last: its threads use the rest
  std::shared_ptr<record::RetainChannel> retained_;  // shared with the thread that writes the store
};

}  // namespace stepwright::host
