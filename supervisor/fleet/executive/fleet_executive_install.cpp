// Bringing a program to run: by an online change from the one that runs, or by download and start.

#include <chrono>
#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::fleet {

using executive::IncidentKind;
using executive::Phase;
using std::chrono::milliseconds;

namespace {

// Longer than any restart that somebody waits for; after it the answer counts as missing.
constexpr milliseconds kPatience{5'000};

}  // namespace

// False if the runtime is lost (phase unchanged) or refuses (phase Safe).
bool FleetExecutive::install(const PreparedFleet& prepared) {
  auto reader = FleetReader::create(prepared.container, *prepared.program);
  if (!reader) {
    return give_up("the program cannot be read: " + result::to_string(reader.error()),
                   IncidentKind::ProgramFault);
  }
  const auto status = controller_.status();
  const bool runs = running_ && status && status->state == host::RuntimeState::Running &&
                    status->program_digest == running_->digest && controller_.alive();
  if (runs) {
    if (auto digest = controller_.change(prepared.container)) {
      running_ = Running{std::move(*digest), std::move(*reader)};
      confirmed_ = false;
      silent_rounds_ = 0;
      return await_event(host::EventKind::Changed);
    }
    // Without a program the forks go down: a load that is aboard would be left where the vehicle stands.
    if (const auto loaded = carrier()) {
      return give_up(
          "the online change was refused, and " + *loaded + " has a load aboard that a download would drop",
          IncidentKind::ProgramFault);
    }
    (void)controller_.stop("the next program cannot take over");
  }
  running_.emplace(Running{{}, std::move(*reader)});
  return download_and_start(prepared);
}

// A vehicle that has a load aboard, if any takes part.
std::optional<std::string> FleetExecutive::carrier() const {
  for (std::size_t v = 0; v < ledger_.vehicles().size(); ++v) {
    const VehicleEntry& entry = ledger_.vehicles()[v];
    if (!entry.aboard.empty() && !entry.lost) return desk_.problem().vehicles[v].name;
  }
  return std::nullopt;
}

bool FleetExecutive::download_and_start(const PreparedFleet& prepared) {
  auto digest = controller_.download(prepared.container);
  if (!digest) {
    return controller_.alive()
               ? give_up("the runtime refuses the program: " + result::to_string(digest.error()),
                         IncidentKind::ProgramFault)
               : false;
  }
  running_->digest = std::move(*digest);
  confirmed_ = false;
  silent_rounds_ = 0;
  if (auto started = controller_.start(options_.barrier); !started) {
    return controller_.alive()
               ? give_up("the runtime does not start the program: " + result::to_string(started.error()),
                         IncidentKind::ProgramFault)
               : false;
  }
  return await_event(host::EventKind::Started);
}

// The news that the program runs. What comes before it is of the one before.
bool FleetExecutive::await_event(host::EventKind kind) {
  for (const auto deadline = std::chrono::steady_clock::now() + kPatience;
       std::chrono::steady_clock::now() < deadline && controller_.alive();) {
    const auto event = controller_.wait_event(milliseconds(200));
    if (!event) continue;
    (void)controller_.acknowledge(event->sequence);
    if (event->kind != kind || event->program_digest != running_->digest) continue;
    clock_.see(event->incarnation, event->time_ns);
    return true;
  }
  return false;
}

}  // namespace stepwright::fleet
