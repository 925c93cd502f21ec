#include "runtime/remote/line_loop.h"

#include <algorithm>

namespace stepwright::remote {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
// A controller that answers and does not scan for this long, or for kStallPeriods of its periods, hangs.
constexpr std::int64_t kStallNs = 1'000 * kNsPerMs;
constexpr std::int64_t kStallPeriods = 4;

std::int64_t ns(std::chrono::milliseconds duration) {
  return std::chrono::nanoseconds(duration).count();
}

}  // namespace

LineLoop::LineLoop(const RemoteConfig& config, RegisterLine& line, image::IoDriver& driver,
                   host::PlantAccess* plant, host::SnapshotWriter& snapshots, LineQueues& queues)
    : config_(config),
      snapshots_(snapshots),
      queues_(queues),
      link_(line, {.patience = config.lost_after}, quit_),
      plant_(config.host, driver, plant),
      gate_(config.host) {
  origin_ns_ = clock_.now_ns();
  publish();
}

void LineLoop::run() {
  while (!quit_.load(std::memory_order_acquire)) {
    take_commands();
    if (!contact_) {
      seek();
      continue;
    }
    const Done turned = simulated() ? turn_lock_step() : turn_by_clock();
    if (!turned) lose(turned.error());
  }
  if (running()) {
    // The last word; what the line does not carry any more the controller's own watch has to do.
    if (contact_) static_cast<void>(link_.command(control::Command::Stop));
    gate_.rest(reading());
    now_.state = host::RuntimeState::Stopped;
    plant_.make_safe(own_time_ns());
    publish();
  }
  plant_.release_outputs();
}

void LineLoop::quit() {
  quit_.store(true, std::memory_order_release);
  queues_.wake().notify();
}

void LineLoop::wait(std::int64_t timeout_ns) {
  queues_.wake().wait(std::max<std::int64_t>(timeout_ns, 0));
}

LineLoop::Done LineLoop::turn_lock_step() {
  const bool held = !running() || !gate_.may_scan() || queues_.full();
  if (!held) {
    const std::int64_t early_ns = gate_.keeps_step() ? gate_.wait_ns(wall_ns(), next_ns_) : 0;
    if (early_ns <= 0) return scan_once();
    publish_if_due();
    wait(early_ns);
    return {};
  }
  publish_if_due();
  const std::int64_t left_ns = status_due_ns_ - wall_ns();
  if (left_ns > 0) {
    wait(left_ns);
    return {};
  }
  return look_at_status();
}

// A controller that was lost or exchanged while it had nothing to do is noticed too.
LineLoop::Done LineLoop::look_at_status() {
  auto status = link_.status();
  if (!status) return result::forward(status);
  if (auto same = check_identity(*status); !same) return same;
  status_due_ns_ = wall_ns() + ns(config_.status_period);
  now_.overruns = status->overruns;
  return take_events(*status);
}

// One turn: the plant's inputs there, the outputs of the scan that they let run back.
LineLoop::Done LineLoop::scan_once() {
  plant_.inject_due(next_ns_);
  if (!plant_.read(next_ns_)) return plant_lost();
  const std::int64_t begin_ns = wall_ns();
  auto answer = link_.turn(next_turn(), plant_.inputs(), plant_.outputs());
  if (!answer) return result::forward(answer);
  turns_.record(wall_ns() - begin_ns);
  if (answer->next_ns + base_ns_ <= next_ns_) {
    return result::fail("R0143", {link_.name(), 0, 0}, "a turn was answered and no scan ran",
                        "was the controller restarted, or has it another master?");
  }
  ++now_.scan;
  now_.time_ns = next_ns_;
  next_ns_ = answer->next_ns + base_ns_;
  if (!plant_.write(now_.time_ns)) return plant_lost();
  const bool stands = gate_.scanned();
  if (answer->event != known_event_) return take_turns_event();
  if (stands || wall_ns() >= image_due_ns_) {
    if (auto checked = check_turn(); !checked) return tl::unexpected(checked.error());
  }
  if (auto read = refresh_image(); !read) return read;
  if (stands) {
    publish();
    queues_.news().notify();
  } else {
    publish_if_due();
  }
  return {};
}

// Both sides have counted the same turns and scans; and what the short answer leaves out.
result::Result<ControllerOutputs> LineLoop::check_turn() {
  auto outputs = link_.outputs(plant_.outputs());
  if (!outputs) return outputs;
  if (outputs->turn != turn_ || outputs->scan != now_.scan) {
    return result::fail("R0143", {link_.name(), 0, 0},
                        "the controller has run scan " + std::to_string(outputs->scan) + " in turn " +
                            std::to_string(outputs->turn) + ", and this was scan " +
                            std::to_string(now_.scan) + " in turn " + std::to_string(turn_),
                        "was it restarted, or has it another master?");
  }
  now_.trace_hash = outputs->trace_hash;
  return outputs;
}

LineLoop::Done LineLoop::take_turns_event() {
  auto outputs = check_turn();
  if (!outputs) return tl::unexpected(outputs.error());
  if (outputs->state == control::State::Running && outputs->event == known_event_ + 1) {
    known_event_ = outputs->event;
    if (auto read = read_event_image(); !read) return read;
    emit(host::EventKind::StepChange, {});
    return {};
  }
  auto status = link_.status();
  if (!status) return result::forward(status);
  return take_events(*status);
}

// By the clock.
void LineLoop::accept(const ControllerOutputs& outputs) {
  if (outputs.scan != now_.scan) progress_ns_ = wall_ns();
  now_.scan = outputs.scan;
  now_.trace_hash = outputs.trace_hash;
  now_.time_ns = own_time_ns();
}

LineLoop::Done LineLoop::turn_by_clock() {
  const std::int64_t left_ns = due_ns_ - wall_ns();
  if (left_ns > 0) {
    wait(left_ns);
    return {};
  }
  due_ns_ = wall_ns() + ns(config_.exchange_period);
  if (program_ != nullptr) {
    if (auto exchanged = exchange_by_clock(); !exchanged) return exchanged;
  }
  if (status_due_ns_ > wall_ns()) {
    publish_if_due();
    return {};
  }
  return look_at_status();
}

// Inputs stay fresh and outputs arrive whether a program runs or not.
LineLoop::Done LineLoop::exchange_by_clock() {
  plant_.inject_due(own_time_ns());
  if (!plant_.read(own_time_ns()) && running()) return plant_lost();
  const std::int64_t begin_ns = wall_ns();
  auto outputs = link_.exchange(next_turn(), plant_.inputs(), plant_.outputs());
  if (!outputs) return result::forward(outputs);
  turns_.record(wall_ns() - begin_ns);
  accept(*outputs);
  if (!plant_.write(own_time_ns()) && running()) return plant_lost();
  if (outputs->event != known_event_) {
    auto status = link_.status();
    if (!status) return result::forward(status);
    if (auto taken = take_events(*status); !taken) return taken;
  }
  const std::int64_t interval_ns = program_->interval_ns();
  const std::int64_t patience_ns = std::max(kStallNs, kStallPeriods * interval_ns);
  if (running() && interval_ns > 0 && wall_ns() - progress_ns_ > patience_ns) {
    return result::fail("R0146", {link_.name(), 0, 0}, "the controller answers and does not scan any more",
                        "its scan " + std::to_string(now_.scan) + " was the last one that was seen");
  }
  return refresh_image();
}

// The plant does not answer, or this process stood still: the controller's outputs go nowhere.
LineLoop::Done LineLoop::plant_lost() {
  const bool stood_still = plant_.stood_still();
  const auto stopped = link_.command(control::Command::Stop);
  if (!stopped) return tl::unexpected(stopped.error());
  auto status = link_.status();
  if (!status) return result::forward(status);
  known_event_ = status->event;
  gate_.rest(reading());
  now_.state = host::RuntimeState::Fault;
  plant_.make_safe(own_time_ns());
  emit(host::EventKind::Trap, stood_still ? host::kStoodStill : host::kIoLost,
       stood_still ? scan::SafeCause::Killed : scan::SafeCause::IoLost);
  return {};
}

}  // namespace stepwright::remote
