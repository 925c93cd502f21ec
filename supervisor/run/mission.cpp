#include "supervisor/run/mission.h"

#include <utility>

namespace stepwright::run {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kMaxSilentRounds = 5;
constexpr milliseconds kLook{200};

bool is_open(const RunRecord& record) {
  return !record.incidents.empty() && record.incidents.back().response == Response::Open;
}

}  // namespace

Mission::Mission(Controller& controller, MissionOptions options, Observer observer)
    : controller_(controller), options_(std::move(options)), observer_(std::move(observer)) {
  record_.cell = options_.cell;
}

RunRecord Mission::run() {
  ended_ = false;
  for (bool going = begin(); going;) going = act_on(follow());
  if (!ended_) enter(Stage::Over);
  return record_;
}

bool Mission::act_on(const Decision& decision) {
  switch (decision.verdict) {
    case Verdict::GoOn:
      break;
    case Verdict::Finished:
      return finish();
    case Verdict::Replan:
      return replan(decision.cause);
    case Verdict::Hold: {
      const auto cause = hold_stopped();
      return cause && replan(*cause);
    }
    case Verdict::RuntimeLost:
      return recover_runtime();
    case Verdict::GiveUp:
      return give_up(decision.cause);
  }
  return true;
}

Decision Mission::follow() {
  while (true) {
    if (abort_) return give_up_because(IncidentKind::Operator, "aborted by the operator");
    if (auto cause = wish()) return {Verdict::Replan, *std::move(cause)};
    const auto event = controller_.wait_event(kLook);
    if (!event) {
      if (runtime_lost()) return {Verdict::RuntimeLost};
      if (auto cause = due(clock_.now_s())) return {Verdict::Replan, *std::move(cause)};
      publish(/*now=*/false);
      continue;
    }
    const Decision decision = judge(*event);
    publish(/*now=*/false);
    // While an emergency stop holds the plant, the clock goes on.
    if (decision.verdict == Verdict::Hold) (void)controller_.acknowledge(event->sequence);
    if (decision.verdict != Verdict::GoOn) return decision;
    (void)controller_.acknowledge(event->sequence);  // a lost runtime shows in the next round
  }
}

Decision Mission::judge(const host::StepEvent& event) {
  // The program before drives the plant again, which knows nothing of this plan.
  if (event.kind == host::EventKind::RolledBack)
    return give_up_because(IncidentKind::ProgramFault,
                           "the program trapped and was rolled back: " + event.detail);
  if (event.program_digest != digest_) return {};  // news of a program that was replaced since
  clock_.see(event.incarnation, event.time_ns);
  switch (event.kind) {
    case host::EventKind::Started:
    case host::EventKind::Changed:
    case host::EventKind::RolledBack:
      return {};
    case host::EventKind::StepChange:
      if (auto cause = watch_.news(event.image)) return {Verdict::Replan, *std::move(cause)};
      return judge_image(event.image);
    case host::EventKind::Trap:
      return trapped(event);
    case host::EventKind::Stopped:
      break;
  }
  return stopped(event);
}

// A monitor may have ended the scan: then that is why.
Decision Mission::trapped(const host::StepEvent& event) {
  const std::string what = "the program trapped: " + event.detail;
  auto cause = watch_.news(event.image);
  if (!cause) return give_up_because(IncidentKind::ProgramFault, what);
  cause->evidence.push_back(what);
  return {Verdict::GiveUp, *std::move(cause)};
}

// Whoever stopped the plant on purpose does not want it to go on by itself.
Decision Mission::stopped(const host::StepEvent& event) {
  if (event.cause != scan::SafeCause::SupervisorLost)
    return give_up_because(IncidentKind::Operator, "stopped from outside: " + event.detail);
  return {Verdict::Replan, {IncidentKind::LostSupervisor, {"the runtime stopped: " + event.detail}}};
}

void Mission::set_phase(Phase phase, std::string message) {
  record_.phase = phase;
  record_.message = std::move(message);
  // Before anybody hears of it: what is asked from then on is asked of a run that is over.
  if (phase == Phase::Done || phase == Phase::Safe) {
    ended_ = true;
    enter(Stage::Over);
  }
  publish(/*now=*/true);
}

void Mission::show(const Pictures& pictures) {
  std::string text = to_json(pictures);
  const std::lock_guard lock(pictures_mutex_);
  pictures_ = std::move(text);
}

std::optional<std::string> Mission::new_pictures() {
  const std::lock_guard lock(pictures_mutex_);
  return std::exchange(pictures_, std::nullopt);
}

void Mission::begin_record() {
  RunRecord fresh;
  fresh.cell = std::move(record_.cell);
  fresh.started_s = clock_.now_s();
  fresh.finished_s = clock_.now_s();
  record_ = std::move(fresh);
}

void Mission::open_incident(const Cause& cause) {
  Incident incident;
  incident.time_s = clock_.now_s();
  incident.kind = cause.kind;
  incident.evidence = cause.evidence;
  incident.action = cause.action;
  opened(incident);
  record_.incidents.push_back(std::move(incident));
  work_begins();
}

void Mission::decide(Response response) {
  if (!is_open(record_)) return;
  record_.incidents.back().response = response;
  work_pauses();
}

void Mission::work_begins() {
  working_since_ = steady_clock::now();
}

void Mission::work_pauses() {
  const auto since = std::exchange(working_since_, std::nullopt);
  if (!since || record_.incidents.empty()) return;
  record_.incidents.back().decision_ms +=
      std::chrono::duration<double, std::milli>(steady_clock::now() - *since).count();
}

bool Mission::give_up(const std::string& reason, IncidentKind kind, result::ExitCode exit) {
  if (!is_open(record_)) open_incident({kind, {reason}});
  std::vector<std::string>& evidence = record_.incidents.back().evidence;
  if (sentence_of(evidence) != reason) evidence.push_back(reason);
  decide(Response::SafeStop);
  std::string message = reason;
  if (drives() && !controller_.stop(reason.substr(0, 200))) {
    message += " (the runtime does not answer; its own rules for a lost supervisor hold)";
  }
  record_.exit = exit;
  set_phase(Phase::Safe, std::move(message));
  return false;
}

bool Mission::give_up(const Cause& cause) {
  if (!is_open(record_)) open_incident(cause);
  return give_up(sentence_of(cause.evidence), cause.kind);
}

bool Mission::give_up(const std::string& what, const result::Diagnostics& diagnostics, IncidentKind kind) {
  return give_up(what + ":\n" + result::to_string(diagnostics), kind);
}

bool Mission::give_up_aborted() {
  return give_up("aborted by the operator", IncidentKind::Operator);
}

// Gone, or back so quickly that it was never missed: then it has not our program any more.
bool Mission::runtime_lost() {
  if (!controller_.alive()) return true;
  const auto status = controller_.status();
  if (status && status->program_digest == digest_) {
    confirmed_ = true;
    silent_rounds_ = 0;
    return false;
  }
  // Right after a download the newest status may still be an old one.
  return confirmed_ || ++silent_rounds_ > kMaxSilentRounds;
}

}  // namespace stepwright::run
