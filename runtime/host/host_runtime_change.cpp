// Online change, as the service thread prepares and reports it.

#include <utility>

#include "runtime/host/host_runtime.h"

namespace stepwright::host {
namespace {

result::Diagnostics problem(const char* code, const char* message, const char* hint) {
  return {{code, result::Severity::Error, {"download", 0, 0}, message, hint}};
}

result::Diagnostics not_running() {
  return problem("R0031", "no program is running that could be changed", "replace the program and start it");
}

}  // namespace

result::Result<void> HostRuntime::change(std::uint64_t ticket, std::vector<std::byte> container,
                                         std::string digest, DownloadMode mode) {
  if (programs_.any_pending()) {
    return tl::unexpected(problem("R0032", "another download is under way", "try again when it is done"));
  }
  const ScanFigures figures = loop_->figures();
  PreparedProgram* const running = programs_.find(figures.program);
  if (running == nullptr || figures.state != RuntimeState::Running) return tl::unexpected(not_running());
  auto program = prepare(std::move(container), std::move(digest));
  if (!program) return result::forward(program);
  auto plan = ChangePlan::make(*running, **program, mode);
  if (!plan) return result::forward(plan);
  Command command;
  command.kind = CommandKind::Change;
  command.ticket = ticket;
  return send(std::move(command), std::move(*program), std::move(*plan));
}

// In words what the scan thread said in numbers.
void HostRuntime::explain(const ProgramShelf::Held& held, Completion& completion) const {
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
      completion.problems = problem(
          "R0035", "the program that ran when this change was prepared was replaced meanwhile", "try again");
      return;
    default:
      completion.problems = not_running();
  }
}

}  // namespace stepwright::host
