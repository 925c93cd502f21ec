// Online change and rollback, as the scan thread performs them between two scans
// (runtime/doc/online_change.md).

#include <array>
#include <cstdio>
#include <utility>

#include "runtime/host/change_plan.h"
#include "runtime/host/scan_loop.h"

namespace stepwright::host {
namespace {

constexpr double kNsPerUs = 1'000.0;

// Forces of variables that only the failed program had. No heap: it is the scan thread's.
FixedText<kMaxReasonBytes> dropped_text(std::uint32_t forces) {
  if (forces == 0) return {};
  std::array<char, kMaxReasonBytes> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%u forces of what only it had are gone", forces);
  return FixedText<kMaxReasonBytes>(std::string_view(text.data(), static_cast<std::size_t>(length)));
}

}  // namespace

// The commands in their order, those that go ahead first. In real time a change is warmed up in this pause
// between two scans and performed in the next one, with the commands behind it waiting; the simulated clock
// stands still meanwhile anyway.
std::optional<Command> ScanLoop::next_command(std::int64_t begin_ns) {
  if (auto command = urgent_.pop()) return command;
  if (!time_for_commands(begin_ns)) {
    commands_left_ = true;
    return std::nullopt;
  }
  if (std::exchange(warm_change_.waiting, false)) return warm_change_.command;
  auto command = commands_.pop();
  const bool running = now_.state == RuntimeState::Running;
  if (!command || command->kind != CommandKind::Change || !real() || !running) return command;
  const auto hold = hold_tasks();
  command->change->warm();
  warm_change_ = {*command, true};
  return std::nullopt;
}

Completion ScanLoop::change(const Command& command) {
  const std::int64_t begin_ns = clock_.now_ns();
  const ChangePlan& plan = *command.change;
  Completion completion;
  completion.ticket = command.ticket;
  const auto refused = [&](Outcome outcome) {
    completion.outcome = outcome;
    return completion;
  };
  if (now_.state != RuntimeState::Running) return refused(Outcome::NotRunning);
  if (program_ != &plan.from()) return refused(Outcome::ChangeOutdated);
  PreparedProgram& before = plan.from();
  if (const auto step = plan.lost_step(before.image().bytes())) {
    completion.detail = *step;
    return refused(Outcome::StepLost);
  }
  if (const auto chart = plan.impossible_chart(before.image().bytes())) {
    completion.detail = *chart;
    return refused(Outcome::StepsUnfit);
  }
  PreparedProgram& next = plan.to();
  plan.carry(before.image(), next.image());
  completion.change.dropped_forces = plan.move_forces(before.cycle().forces(), next.cycle().forces());
  const auto hold = next.task_threads().hold();
  next.cycle().take_over(before.cycle(), plan.tasks());
  next.task_threads().take_over(before.task_threads(), plan.tasks(), next.cycle().next_time_ns());
  end_trial();  // of an earlier change: it has run without a trap so far
  retain_from(next);
  adopt(next);
  tap_.state(record::StateCause::Change, running());
  now_.kept = &before;  // without a trial until its tasks are let go
  if (config_.change_trial_scans > 0) {
    trial_ = {&plan, config_.change_trial_scans};
    next.cycle().hold_outputs_on_trap(true);
  }
  ++now_.changes;
  // Whoever changed the program has decided; nothing waits for its word any more.
  gate_.release(reading());
  note(EventKind::Changed, {}, {}, &before);
  // Who sees the completion sees these figures: take_commands publishes them in front of it.
  now_.last_change_pause_ns = clock_.now_ns() - begin_ns;
  completion.change.pause_us = static_cast<double>(now_.last_change_pause_ns) / kNsPerUs;
  return completion;
}

// After each scan of a program on trial. True if the old program has taken over again.
bool ScanLoop::tried(const scan::ScanReport& report) {
  if (report.state == scan::ScanState::Trapped || report.state == scan::ScanState::WatchdogExpired) {
    roll_back(report.trap);
    return true;
  }
  if (report.state != scan::ScanState::Running || --trial_.scans_left == 0) end_trial();
  return false;
}

// The outputs are as the scan before the trap left them, and what a stop would hold are those; the old
// program drives them from the next scan on, with fresh inputs and the values that it had at the swap.
void ScanLoop::roll_back(const bytecode::Trap& trap) {
  const ChangePlan& plan = *trial_.plan;
  PreparedProgram& failed = plan.to();
  PreparedProgram& before = plan.from();
  // Two programs' mutexes are held only here and in change(), by one thread: their order is free.
  const auto hold = before.task_threads().hold();
  before.cycle().take_over(failed.cycle(), plan.tasks_back());
  before.task_threads().take_over(failed.task_threads(), plan.tasks_back(), before.cycle().next_time_ns());
  const std::uint32_t dropped = plan.move_forces_back(failed.cycle().forces(), before.cycle().forces());
  retain_from(before);
  adopt(before);
  tap_.state(record::StateCause::Change, running());
  publish_forces();
  trial_ = {};
  now_.kept = &failed;  // until the event, which speaks of it, is on its way
  gate_.stand(reading());
  emit(EventKind::RolledBack, trap, dropped_text(dropped).view(), &failed);
  now_.kept = nullptr;
}

// What another program retains is kept from now on. One that retains nothing leaves what there is for the
// program that wants it.
void ScanLoop::retain_from(PreparedProgram& next) {
  if (next.retained().values.size() == 0) retain_.finish(program_->image().bytes());
  retain_.change(next.retained(), next.image().bytes());
}

void ScanLoop::end_trial() {
  if (!trial_.active()) return;
  program_->cycle().hold_outputs_on_trap(false);
  trial_ = {};
  now_.kept = nullptr;
}

}  // namespace stepwright::host
