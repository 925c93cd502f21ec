// Downloads and online changes, as the service thread has them prepared and reports them.

#include <new>
#include <utility>

#include "runtime/host/busy.h"
#include "runtime/host/change_codes.h"
#include "runtime/host/host_runtime.h"

namespace stepwright::host {
namespace {

result::Diagnostics problem(const char* code, const char* message, const char* hint) {
  return {{code, result::Severity::Error, {"download", 0, 0}, message, hint}};
}

result::Diagnostics not_running() {
  return problem(kNoProgramRuns, "no program is running that could be changed",
                 "replace the program and start it");
}

}  // namespace

result::Result<void> HostRuntime::load(std::uint64_t ticket, std::vector<std::byte> container,
                                       std::string digest) {
  return preparer_.submit({ticket, std::move(container), std::move(digest), DownloadMode::Replace, nullptr});
}

result::Result<void> HostRuntime::change(std::uint64_t ticket, std::vector<std::byte> container,
                                         std::string digest, DownloadMode mode) {
  if (programs_.any_pending() || preparer_.under_way() > 0) {
    return tl::unexpected(
        problem(kDownloadUnderWay, "another download is under way", "try again when it is done"));
  }
  const ScanFigures figures = loop_->figures();
  PreparedProgram* const running = programs_.find(figures.program);
  if (running == nullptr || figures.state != RuntimeState::Running) return tl::unexpected(not_running());
  auto accepted = preparer_.submit({ticket, std::move(container), std::move(digest), mode, running});
  if (accepted) changing_ = ticket;
  return accepted;
}

// On the preparer's thread: nothing here is changed by any other while a job is under way.
result::Result<Preparation> HostRuntime::prepare(PreparationJob job) {
  Preparation done;
  auto program = PreparedProgram::create(
      std::move(job.container), std::move(job.digest),
      {io_, loop_->clock(), config_, &loop_->liveness(), &monitor_, loop_->clock_origin_ns(),
       plant_names_.size(), [loop = loop_.get()] { loop->task_failed(); }});
  if (!program) return result::forward(program);
  auto retained = retain_->prepare((*program)->loaded().program());
  if (!retained) return result::forward(retained);
  (*program)->set_retained(std::move(*retained));
  if (job.mode != DownloadMode::Replace) {
    auto plan = ChangePlan::make(*job.running, **program, job.mode);
    if (!plan) return result::forward(plan);
    done.plan = std::move(*plan);
  }
  done.program = std::move(*program);
  return done;
}

// Hands the programs that are ready to the scan thread, and after them the starts that waited for them.
void HostRuntime::take_preparations() {
  while (auto prepared = preparer_.take()) {
    const std::uint64_t ticket = prepared->ticket;
    if (changing_ == ticket) changing_.reset();
    auto problems = std::move(prepared->problems);
    if (prepared->program != nullptr) {
      auto handed = hand_over(std::move(*prepared));
      if (handed) continue;
      problems = std::move(handed.error());
    }
    refusals_.push_back({ticket, Outcome::Refused, std::move(problems)});
  }
  while (!starts_.empty() && preparer_.under_way() == 0) {
    --commands_under_way_;
    // There is room: it was counted all the time.
    static_cast<void>(pass_on(starts_.front()));
    starts_.pop_front();
  }
}

result::Result<void> HostRuntime::hand_over(Preparation prepared) {
  Command command;
  command.kind = prepared.plan == nullptr ? CommandKind::Load : CommandKind::Change;
  command.ticket = prepared.ticket;
  command.program = prepared.program.get();
  command.change = prepared.plan.get();
  try {
    if (recorder_.active())
      recorder_.announce(prepared.program->digest(), prepared.program->loaded().bytes());
  } catch (const std::bad_alloc&) {
    return result::fail("R0072", {"download", 0, 0}, "the system gives no memory to record the program",
                        "end the recording first; nothing was changed");
  }
  if (!send(command)) return busy();
  programs_.add(std::move(prepared.program), std::move(prepared.plan), command.ticket);
  return {};
}

// In words what the scan thread said in numbers.
void HostRuntime::explain(const ProgramRegistry::Held& held, Completion& completion) const {
  switch (completion.outcome) {
    case Outcome::Done: {
      ChangeReport report = held.plan->report();
      report.dropped_forces = completion.change.dropped_forces;
      report.pause_us = completion.change.pause_us;
      completion.change = report;
      completion.problems = held.plan->notes();
      return;
    }
    case Outcome::StepLost:
      completion.problems = {held.plan->lost_step_problem(completion.detail)};
      return;
    case Outcome::StepsUnfit:
      completion.problems = {held.plan->impossible_chart_problem(completion.detail)};
      return;
    case Outcome::ChangeOutdated:
      completion.problems =
          problem(kReplacedMeanwhile,
                  "the program that ran when this change was prepared was replaced meanwhile", "try again");
      return;
    default:
      completion.problems = not_running();
  }
}

}  // namespace stepwright::host
