#pragma once

// Plan of an online change, by which a program takes over from the running one between two scans: which
// values, steps, forces and task phases go where, and what would make it unsafe. Everything that takes time
// is done here, on the service thread and beside the running program; what is left for the scan thread is a
// list of copies.
//
// Threads: made by the service thread; the functions under "scan thread" belong to that one afterwards; the
// reports are read by the service thread at any time, as they do not change. No heap, lock or failure on the
// scan thread. Diagnostics: R0031 no program runs, R0032 another download is under way, R0033 an active step
// would be lost, R0034 an output would move to another terminal, R0035 the program that ran was replaced
// meanwhile, R0036 the steps that are active would be no situation of the new chart; notes: R0037 what was
// carried, R0038 what was not.
//
//   auto plan = ChangePlan::make(running, next, DownloadMode::Change);
//   if (plan->lost_step(image)) ...                      // refused: nothing has changed
//   plan->carry(running.image(), next.image());

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/address_map.h"
#include "runtime/host/chart_carry.h"
#include "runtime/host/chart_situations.h"
#include "runtime/host/messages.h"
#include "runtime/host/output_drivers.h"
#include "runtime/host/prepared_program.h"
#include "runtime/image/force_table.h"
#include "runtime/record/variable_transfer.h"

namespace stepwright::host {

class ChangePlan {
 public:
  // Fails with R0034. Both programs must outlive the plan; neither is changed. Requires a mode other than
  // Replace.
  [[nodiscard]] static result::Result<std::unique_ptr<ChangePlan>> make(PreparedProgram& from,
                                                                        PreparedProgram& to,
                                                                        DownloadMode mode);

  PreparedProgram& from() const { return from_; }
  PreparedProgram& to() const { return to_; }

  // Scan thread.
  // A step that is active in this image of the old program and has no counterpart; none: the change is safe.
  std::optional<std::uint32_t> lost_step(std::span<const std::byte> image) const {
    return charts_.lost_step(image);
  }
  // A chart of the new program that could never have these steps active together; none: the change is safe.
  std::optional<std::uint32_t> impossible_chart(std::span<const std::byte> image) const {
    return situations_.impossible(image);
  }
  // Brings what `carry` reads and writes near the processor: a scan earlier, so that the swap is short.
  void warm() const;
  // Fills the new image, which holds its initial values.
  void carry(const image::ProcessImage& from, image::ProcessImage& to) const;
  // The forces of one program as forces of the other, by variable. Returns how many had no place any more.
  std::uint32_t move_forces(const image::ForceTable& from, image::ForceTable& to) const;
  // At a rollback. What `to` has forced at the swap and the failed program had no place for is forced again.
  std::uint32_t move_forces_back(const image::ForceTable& from, image::ForceTable& to) const;
  // For ScanCycle::take_over, in either direction.
  std::span<const std::uint32_t> tasks() const { return tasks_; }
  std::span<const std::uint32_t> tasks_back() const { return tasks_back_; }

  // Service thread.
  result::Diagnostic lost_step_problem(std::uint32_t step) const;
  result::Diagnostic impossible_chart_problem(std::uint32_t chart) const;
  // Notes about carried and other variables; bounded, with the first names of each kind.
  result::Diagnostics notes() const;
  // Pause and forces are not known yet.
  ChangeReport report() const;

 private:
  ChangePlan(PreparedProgram& from, PreparedProgram& to, DownloadMode mode);
  [[nodiscard]] result::Result<void> plan();
  void pair_tasks();
  void clear_outputs();

  PreparedProgram& from_;
  PreparedProgram& to_;
  DownloadMode mode_;
  record::VariableTransfer transfer_;
  AddressMap forward_;
  AddressMap backward_;
  ChartCarry charts_;
  ChartSituations situations_;
  std::vector<std::uint8_t> initial_outputs_;  // per byte of the output area: bits with their initial values
  mutable std::uint32_t touched_ = 0;          // so that touching has a result
  std::vector<std::uint32_t> tasks_;
  std::vector<std::uint32_t> tasks_back_;
};

}  // namespace stepwright::host
