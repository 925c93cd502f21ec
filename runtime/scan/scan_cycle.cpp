#include "runtime/scan/scan_cycle.h"

#include <cassert>

#include "runtime/base/hash64.h"

namespace stepwright::scan {

using bytecode::Section;

ScanCycle::ScanCycle(const bytecode::Program& program, bytecode::Engine& engine, image::ProcessImage& image,
                     image::IoDriver& io, Clock& clock, const ScanConfig& config)
    : program_(program), engine_(engine), image_(image), io_(io), clock_(clock), config_(config) {
  assert(image.memory().size() == program.memory_size());
  load_tasks();
}

image::ImageLayout layout_of(const bytecode::Program& program) {
  const bytecode::SizesRecord& sizes = program.sizes();
  return {sizes.input_bytes, sizes.output_bytes, sizes.marker_bytes, sizes.data_bytes,
          program.memory_size() - program.image_size()};
}

// Sorts the tasks by priority; tasks of equal priority keep the order of the table.
void ScanCycle::load_tasks() {
  const bytecode::ContainerView& view = program_.container();
  for (std::uint32_t i = 0; i < view.count<Section::Tasks>(); ++i) {
    const bytecode::TaskRecord record = view.record<Section::Tasks>(i);
    std::size_t at = task_count_++;
    for (; at > 0 && tasks_[at - 1].priority > record.priority; --at) tasks_[at] = tasks_[at - 1];
    TaskState& task = tasks_[at];
    task = {};
    task.index = i;
    task.interval_ns = std::int64_t{record.interval_us} * 1000;
    task.priority = record.priority;
    task.first_call = record.first_call;
    task.call_count = record.call_count;
    task.frames = program_.frames_of(i);
    if (record.trigger == bytecode::kNoIndex) continue;
    const bytecode::SymbolRecord symbol = view.record<Section::Symbols>(record.trigger);
    task.trigger = symbol.address;
    task.trigger_bit = symbol.bit;
  }
}

void ScanCycle::start(const StartPoint& at) {
  image_.reset(program_.container().section(Section::InitialData));
  forces_.clear_all();
  for (TaskState& task : tasks()) {
    task.due_ns = task.interval_ns > 0 ? at.time_ns : kNever;
    task.triggered = false;
  }
  scan_ = at.scan;
  last_time_ns_ = at.time_ns;
  trace_hash_ = at.trace_hash;
  last_trap_ = {};
  state_ = ScanState::Running;
}

void ScanCycle::stop() {
  state_ = ScanState::Stopped;
  write_outputs(last_time_ns_);
}

void ScanCycle::take_over(const ScanCycle& before, std::span<const std::uint32_t> counterparts) {
  assert(before.state_ != ScanState::Stopped && counterparts.size() >= task_count_);
  const std::int64_t next_ns = before.next_time_ns();
  for (TaskState& task : tasks()) {
    task.due_ns = task.interval_ns > 0 ? next_ns : kNever;
    task.triggered = false;
    for (const TaskState& other : before.tasks()) {
      if (other.index != counterparts[task.index]) continue;
      task.triggered = other.triggered;
      if (task.interval_ns == 0 || other.interval_ns == 0) continue;
      // A shorter interval must not wait for the end of the longer one before it.
      const std::int64_t latest_ns = next_ns + task.interval_ns;
      task.due_ns = other.due_ns < latest_ns ? other.due_ns : latest_ns;
    }
  }
  scan_ = before.scan_;
  last_time_ns_ = before.last_time_ns_;
  trace_hash_ = before.trace_hash_;
  statistics_ = before.statistics_;
  last_trap_ = {};
  state_ = ScanState::Running;
}

std::int64_t ScanCycle::next_time_ns() const {
  std::int64_t next = tasks_[0].due_ns;
  for (std::size_t i = 1; i < task_count_; ++i) {
    if (tasks_[i].due_ns < next) next = tasks_[i].due_ns;
  }
  return next;
}

void ScanCycle::skip_to(std::int64_t time_ns) {
  for (TaskState& task : tasks()) {
    if (task.due_ns >= time_ns) continue;  // also what waits for its trigger only
    const std::int64_t missed = (time_ns - task.due_ns + task.interval_ns - 1) / task.interval_ns;
    task.due_ns += missed * task.interval_ns;
  }
}

ScanReport ScanCycle::run_scan() {
  const std::int64_t begin_ns = clock_.now_ns();
  const std::int64_t time_ns = next_time_ns();
  last_time_ns_ = time_ns;
  ++scan_;
  const bool was_running = state_ == ScanState::Running;

  const bool inputs_good = io_.read_inputs(time_ns, image_.inputs()) == image::IoStatus::Good;
  if (was_running && !inputs_good) {
    state_ = ScanState::IoLost;
    ++statistics_.io_losses;
  }
  if (state_ == ScanState::Running) run_tasks(time_ns);
  advance(time_ns);
  if (state_ != ScanState::Trapped || !hold_outputs_on_trap_) write_outputs(time_ns);

  ScanReport report{state_, scan_, time_ns, image_.hash(), {}};
  if (was_running && state_ == ScanState::Trapped) report.trap = last_trap_;
  trace_hash_ = base::hash_mix(base::hash_mix(trace_hash_, scan_), report.image_hash);
  ++statistics_.scans;
  statistics_.scan_time.record(clock_.now_ns() - begin_ns);
  return report;
}

// A rising edge of the trigger runs the task; while the trigger is TRUE its interval does not (IEC 61131-3,
// table 63: SINGLE and INTERVAL).
bool ScanCycle::is_to_run(TaskState& task, std::int64_t time_ns) const {
  const bool due = task.due_ns == time_ns;
  if (task.trigger == bytecode::kNoIndex) return due;
  const auto byte = std::to_integer<unsigned>(image_.bytes()[task.trigger]);
  const bool now = task.trigger_bit == bytecode::kNoBit ? byte != 0 : ((byte >> task.trigger_bit) & 1u) != 0;
  const bool edge = now && !task.triggered;
  task.triggered = now;
  return edge || (due && !now);
}

// The tasks that are due, forces before and after them. A trap ends the scan's tasks.
void ScanCycle::run_tasks(std::int64_t time_ns) {
  const std::int64_t begin_ns = clock_.now_ns();
  forces_.apply(image_.bytes());
  std::uint64_t budget = config_.budget;
  for (TaskState& task : tasks()) {
    if (is_to_run(task, time_ns) && !run_calls(task, time_ns, budget)) break;
  }
  forces_.apply(image_.bytes());
  statistics_.program_time.record(clock_.now_ns() - begin_ns);
}

bool ScanCycle::run_calls(const TaskState& task, std::int64_t time_ns, std::uint64_t& budget) {
  for (std::uint32_t i = 0; i < task.call_count; ++i) {
    const auto call = program_.container().record<Section::ProgramCalls>(task.first_call + i);
    const bytecode::Trap trap =
        engine_.run({call.function, call.instance, time_ns, task.frames}, image_.memory(), budget);
    if (!trap) continue;
    last_trap_ = trap;
    state_ = ScanState::Trapped;
    ++statistics_.traps;
    return false;
  }
  return true;
}

void ScanCycle::advance(std::int64_t time_ns) {
  for (TaskState& task : tasks()) {
    if (task.due_ns == time_ns) task.due_ns += task.interval_ns;
  }
}

// In any state but Running the outputs are in their safe state, forces or not.
void ScanCycle::write_outputs(std::int64_t time_ns) {
  if (state_ != ScanState::Running) apply_safe_state(config_.safe_outputs, image_.outputs());
  const bool written = io_.write_outputs(time_ns, image_.outputs()) == image::IoStatus::Good;
  if (written || state_ != ScanState::Running) return;
  state_ = ScanState::IoLost;
  ++statistics_.io_losses;
  apply_safe_state(config_.safe_outputs, image_.outputs());
  // The device may be reachable for this last word; nothing more can be done if it is not.
  static_cast<void>(io_.write_outputs(time_ns, image_.outputs()));
}

}  // namespace stepwright::scan
