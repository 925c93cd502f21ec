// Bringing a program to run: by an online change from the one that runs, so that the plant is never without
// control, or by download and start.

#include <algorithm>
#include <utility>

#include "supervisor/run/mission.h"

namespace stepwright::run {
namespace {

using std::chrono::milliseconds;

// Longer than any restart that somebody waits for; after it the answer counts as missing.
constexpr milliseconds kPatience{5'000};

}  // namespace

bool Mission::await_runtime() {
  while (!controller_.wait_for_runtime(milliseconds(1'000))) {
    if (abort_) return give_up_aborted();
    if (record_.phase != Phase::Waiting) set_phase(Phase::Waiting, "waiting for the runtime");
  }
  return true;
}

bool Mission::await_answer() {
  if (controller_.alive()) return true;
  set_phase(Phase::Waiting, "the runtime does not answer; waiting for it");
  return await_runtime();
}

bool Mission::has_gone_on() {
  const Phase phase = record_.phase;
  const std::string message = record_.message;
  if (!await_answer() || !runs()) return false;
  open_incident({IncidentKind::LostRuntime, {"the runtime was not seen for a while; it has gone on"}});
  decide(Response::GoOn);
  set_phase(phase, message);
  return true;
}

bool Mission::bring_to_run(const std::function<bool()>& install) {
  while (!install()) {
    if (record_.phase == Phase::Safe || !await_runtime()) return false;
  }
  return true;
}

bool Mission::runs_program(std::span<const std::byte> container) {
  const auto program = controller_.program();
  const auto status = controller_.status();
  const bool runs = program && std::ranges::equal(*program, container) && status &&
                    status->state == host::RuntimeState::Running && status->program_digest == digest_;
  if (runs) watch_.begin(container, true);
  return runs;
}

double Mission::shown_time(const std::optional<host::Snapshot>& snapshot, double now_s) const {
  if (!snapshot || snapshot->program_digest != digest_) return now_s;
  return std::max(now_s, clock_.at(snapshot->incarnation, snapshot->time_ns));
}

bool Mission::runs() const {
  const auto status = controller_.status();
  return !digest_.empty() && status && status->state == host::RuntimeState::Running &&
         status->program_digest == digest_ && controller_.alive();
}

bool Mission::change(std::span<const std::byte> container) {
  auto digest = controller_.change(container);
  if (digest) brought(std::move(*digest));
  if (digest) watch_.begin(container, false);  // its charts begin anew, and monitors with them
  return digest.has_value();
}

bool Mission::download(std::span<const std::byte> container) {
  auto digest = controller_.download(container);
  if (digest) {
    brought(std::move(*digest));
    watch_.begin(container, false);
    return true;
  }
  return controller_.alive() ? give_up("the runtime refuses the program", digest.error()) : false;
}

bool Mission::start() {
  if (auto started = controller_.start(options_.barrier); !started) {
    return controller_.alive() ? give_up("the runtime does not start the program", started.error()) : false;
  }
  return await_event(host::EventKind::Started);
}

void Mission::brought(std::string digest) {
  digest_ = std::move(digest);
  confirmed_ = false;
  silent_rounds_ = 0;
}

// What comes before it is of the program before.
bool Mission::await_event(host::EventKind kind) {
  for (const auto deadline = std::chrono::steady_clock::now() + kPatience;
       std::chrono::steady_clock::now() < deadline && controller_.alive();) {
    const auto event = controller_.wait_event(milliseconds(200));
    if (!event) continue;
    (void)controller_.acknowledge(event->sequence);
    if (event->kind != kind || event->program_digest != digest_) continue;
    clock_.see(event->incarnation, event->time_ns);
    return true;
  }
  return false;
}

}  // namespace stepwright::run
