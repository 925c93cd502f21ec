#include "programs/download/program_verdict.h"

#include <optional>
#include <variant>

namespace stepwright::download {
namespace {

using host::EventKind;

// What an event decides; nothing where it only says when the program began.
std::optional<ProgramVerdict> decided_by(const host::StepEvent& event) {
  switch (event.kind) {
    case EventKind::RolledBack:
      return ProgramVerdict{Verdict::TakenBack, event.detail};
    case EventKind::Trap:
      return ProgramVerdict{Verdict::Fault, event.detail};
    case EventKind::Stopped:
      return ProgramVerdict{Verdict::Open, event.detail};
    default:
      return std::nullopt;
  }
}

}  // namespace

ProgramVerdict await_verdict(service::Connection& connection, const std::string& digest, std::uint32_t scans,
                             std::chrono::milliseconds time) {
  const auto deadline = std::chrono::steady_clock::now() + time;
  std::optional<std::uint64_t> begun;  // the scan before its first one
  while (std::chrono::steady_clock::now() < deadline && !connection.closed()) {
    const auto message = connection.receive(std::chrono::milliseconds(100));
    if (!message) continue;
    if (const auto* event = std::get_if<host::StepEvent>(&*message)) {
      if (event->kind == EventKind::Changed || event->kind == EventKind::Started) begun = event->scan;
      if (auto decided = begun ? decided_by(*event) : std::nullopt) return *decided;
    }
    const auto* status = std::get_if<host::RuntimeStatus>(&*message);
    if (status == nullptr || !begun || status->program_digest != digest) continue;
    if (status->state == host::RuntimeState::Running && status->scan >= *begun + scans)
      return {Verdict::Runs, {}};
  }
  return {Verdict::Open, "its first scans are not over"};
}

}  // namespace stepwright::download
