#include "cell/runtime/process_monitor.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "cell/config/reload.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/host_options.h"
#include "runtime/bytecode/container_parse.h"
#include "runtime/host/state_name.h"

namespace stepwright::cell_runtime {
namespace {

using std::chrono::nanoseconds;

// A scan that is late by this hangs; nothing that the system does to a process takes so long.
constexpr std::chrono::milliseconds kPatience{500};

const char* word(host::RuntimeState state) {
  return state == host::RuntimeState::Empty ? "no program is loaded" : host::name_of(state);
}

// Between two scans of a verified program, on the scan clock.
nanoseconds period_of(std::span<const std::byte> container) {
  bytecode::ContainerView view;
  if (container.empty() || !bytecode::parse_container(container, view).ok()) return nanoseconds(0);
  std::uint32_t shortest_us = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t i = 0; i < view.count<bytecode::Section::Tasks>(); ++i) {
    const std::uint32_t interval_us = view.record<bytecode::Section::Tasks>(i).interval_us;
    if (interval_us > 0) shortest_us = std::min(shortest_us, interval_us);
  }
  return nanoseconds(std::int64_t{shortest_us} * 1'000);
}

}  // namespace

ProcessMonitor::ProcessMonitor(config::CellConfig config, log::Logger& log, process::NotifySocket& init)
    : config_(std::move(config)),
      log_(log),
      init_(init),
      heartbeat_(init),
      journal_(log),
      pulse_(kPatience) {}

void ProcessMonitor::attach(service::Server& server, const host::RuntimePort& port) {
  server_ = &server;
  port_ = &port;
  pulse_.see(port.status(), ScanPulse::Clock::now());
}

void ProcessMonitor::turn() {
  if (pulse_.alive(ScanPulse::Clock::now())) heartbeat_.turn();
}

void ProcessMonitor::on_event(const host::StepEvent& event) {
  journal_.event(event);
  if (watch_ != nullptr) watch_->event(event);
}

void ProcessMonitor::on_stop() {
  if (watch_ != nullptr) watch_->stop_asked();
}

void ProcessMonitor::on_supervisor(bool alive) {
  journal_.supervisor(alive);
  if (watch_ != nullptr) watch_->supervisor(alive);
}

void ProcessMonitor::on_status(const host::RuntimeStatus& status) {
  journal_.status(status);
  if (listener_) listener_(status);
  if (status.program_digest != digest_ && port_ != nullptr) {
    digest_ = status.program_digest;
    const nanoseconds period = period_of(port_->program());
    const bool slowed = config_.clock.mode == config::ClockMode::Simulated && config_.clock.speed > 0.0;
    const double factor = slowed ? 1.0 / std::max(config_.clock.speed, 1e-3) : 1.0;
    pulse_.set_period(nanoseconds(static_cast<std::int64_t>(static_cast<double>(period.count()) * factor)));
  }
  pulse_.see(status, ScanPulse::Clock::now());
  tell_state(status);
}

void ProcessMonitor::tell_state(const host::RuntimeStatus& status) {
  if (!init_.present()) return;
  std::string state = word(status.state);
  if (status.waiting_for_supervisor) state += ", waiting for the supervisor";
  if (!status.detail.empty()) state += ": " + status.detail;
  if (state == told_) return;
  told_ = std::move(state);
  init_.status(told_);
}

result::Diagnostics ProcessMonitor::reload() {
  init_.reloading();
  auto again = config::reload_cell(config_, {"log.", "safe_state.supervisor_lost_after_ms"});
  result::Diagnostics problems;
  if (!again) {
    problems = std::move(again.error());
  } else {
    // A file that a restart would refuse is refused now, while the previous one still holds.
    if (auto options = host_options(again->wanted); !options) problems = std::move(options.error());
    const result::Diagnostics io = check_cell_io(again->wanted);
    problems.insert(problems.end(), io.begin(), io.end());
    // Also when it is the same: its file may have been moved away.
    if (!result::has_errors(problems)) {
      if (auto opened = log_.reopen(again->config.log); !opened) problems = std::move(opened.error());
    }
  }
  if (result::has_errors(problems)) {
    log_.error("reload",
               "the configuration was refused, the previous one holds: " + result::to_string(problems));
  } else {
    config_ = std::move(again->config);
    if (server_ != nullptr) server_->set_supervisor_lost_after(config_.supervisor_lost_after);
    problems = std::move(again->notes);
    log_.info("reload", problems.empty()
                            ? "the configuration was read again: nothing has changed"
                            : "the configuration was read again: " + result::to_string(problems));
  }
  init_.ready(told_);
  return problems;
}

}  // namespace stepwright::cell_runtime
