#pragma once

// A verified program with all the memory that running it takes: image, stack, engine, scan, step watch, event
// ring. Built by the service thread; handed to the scan thread, which runs it until the next one comes;
// destroyed by the service thread again.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/host/area_driver.h"
#include "runtime/host/bool_bytes.h"
#include "runtime/host/engine_choice.h"
#include "runtime/host/event_ring.h"
#include "runtime/host/step_watch.h"
#include "runtime/image/process_image.h"
#include "runtime/record/retained_values.h"
#include "runtime/result/result.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::host {

class PreparedProgram {
 public:
  // Verifies the container and takes its memory. Fails with the diagnostics of the verifier, or with R0004
  // where the program needs more than a cell or a message can carry, or R0010 (see make_engine). What is
  // passed by reference must outlive the program.
  [[nodiscard]] static result::Result<std::unique_ptr<PreparedProgram>> create(
      std::vector<std::byte> container, std::string digest, AreaDriver& io, scan::Clock& clock,
      const scan::ScanConfig& config, std::size_t plant_values, EngineKind engine);

  PreparedProgram(const PreparedProgram&) = delete;
  PreparedProgram& operator=(const PreparedProgram&) = delete;

  const std::string& digest() const { return digest_; }
  const reader::LoadedProgram& loaded() const { return loaded_; }

  // What it retains, with the buffers for it; set before it is handed over.
  record::RetainChannel& retained() const { return *retained_; }
  void set_retained(std::shared_ptr<record::RetainChannel> retained) { retained_ = std::move(retained); }

  // Scan thread only.
  // Before its first scan: what an online change is about to write comes near the processor.
  void warm();
  image::ProcessImage& image() { return image_; }
  scan::ScanCycle& cycle() { return cycle_; }
  StepWatch& steps() { return steps_; }
  const BoolBytes& bools() const { return machine_.bools; }
  // Pushed by the scan thread, popped by the service thread.
  EventRing& events() { return events_; }

 private:
  struct Machine {
    std::unique_ptr<bytecode::Engine> engine;
    BoolBytes bools;
  };
  PreparedProgram(reader::LoadedProgram loaded, Machine machine, std::string digest, AreaDriver& io,
                  scan::Clock& clock, const scan::ScanConfig& config, std::size_t plant_values);

  std::string digest_;
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  Machine machine_;
  image::ProcessImage image_;
  scan::ScanCycle cycle_;
  StepWatch steps_;
  EventRing events_;
  std::shared_ptr<record::RetainChannel> retained_;  // shared with the thread that writes the store
};

}  // namespace stepwright::host
