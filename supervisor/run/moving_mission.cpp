#include "supervisor/run/moving_mission.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/service/answer_codes.h"

namespace stepwright::run {

MovingMission::MovingMission(Controller& controller, MissionOptions options, MovingOptions moving,
                             MovingWords words, Observer observer)
    : Mission(controller, std::move(options), std::move(observer)),
      moving_(moving),
      hold_(words.what + (words.many ? " are" : " is")),
      words_(std::move(words)) {}

Cause MovingMission::resumed() {
  return {IncidentKind::Operator, {words_.what + (words_.many ? " go on" : " goes on")}};
}

std::string MovingMission::nobody_came(const Cause& cause, Phase) const {
  return cause.evidence.front() + "; nobody has let " + words_.what + " go on";
}

// What came with a start is the first thing that is planned.
bool MovingMission::begin_from_rest(const std::string& waits) {
  set_phase(Phase::Planning, waits);
  if (!await_operator("nothing moves until an operator starts it")) return false;
  (void)due(clock_.now_s());
  return await_runtime() && bring_to_rest() && plan_from_rest();
}

bool MovingMission::replan(const Cause& cause) {
  const std::string why = sentence_of(cause.evidence);
  record_.replans.push_back({clock_.now_s(), why, {}, hold_.wanted()});
  open_incident(cause);
  if (!hold_.wanted() && static_cast<int>(counted(record_.replans)) > moving_.max_replans)
    return give_up(fmt::format("{} plans were not enough: {}", moving_.max_replans, why), cause.kind);
  set_phase(hold_.wanted() ? Phase::Holding : Phase::Replanning, why);
  return bring_to_rest() && plan_from_rest();
}

std::optional<Cause> MovingMission::hold(const Cause& cause, Phase phase, const std::string& message) {
  hold_.begin();
  held();
  const auto held_s = hold_at_rest({.cause = cause,
                                    .phase = phase,
                                    .message = message,
                                    .most = moving_.hold,
                                    .stopped = words_.stopped,
                                    .left = nobody_came(cause, phase),
                                    .holds = [this] { return hold_.holds(); },
                                    .see = [this](std::span<const std::byte> image) { see(image); }});
  return held_s ? std::optional(resumed()) : std::nullopt;
}

bool MovingMission::stay(const std::string& reason, IncidentKind kind) {
  if (nobody_comes()) return give_up(reason, kind);
  decide(Response::Replan);
  (void)controller_.acknowledge(rested_at_);  // the clock goes on while it is held
  return go_on(hold({kind, {reason}}, Phase::Held,
                    fmt::format("{}: {} until {}, with {} perhaps, or aborted", reason, words_.rests,
                                words_.until, words_.another)));
}

bool MovingMission::stay_held() {
  decide(Response::Replan);
  (void)controller_.acknowledge(rested_at_);
  const std::string rests = "held by the operator: " + words_.rests;
  return go_on(hold({IncidentKind::Operator, {rests}}, Phase::Held,
                    fmt::format("{} until {} or aborted", rests, words_.until)));
}

bool MovingMission::stay_stopped() {
  decide(Response::Replan);
  return go_on(hold_stopped());
}

bool MovingMission::go_on(const std::optional<Cause>& cause) {
  if (!cause) return false;
  open_incident(*cause);
  set_phase(Phase::Replanning, cause->evidence.front());
  return true;
}

std::optional<Cause> MovingMission::decide_request(const Cause& cause, bool replans) {
  if (cause.evidence.empty()) return std::nullopt;
  if (replans && !hold_.holds()) return cause;
  open_incident(cause);
  decide(Response::GoOn);
  return std::nullopt;
}

result::Result<void> MovingMission::accept(bool moves, const std::function<void()>& add) {
  const std::lock_guard lock(requests_mutex_);
  if (stage_ != Stage::Running && moves)
    return result::fail(service::kNotNow, {}, "nothing moves yet", "the run waits for its start");
  add();
  return {};
}

bool MovingMission::relieve(bool runs, std::span<const std::byte> container,
                            const std::function<void()>& taken) {
  const bool took_over = runs && change(container);
  if (runs && !took_over) (void)controller_.stop("the next program cannot take over");
  taken();
  if (took_over) return await_event(host::EventKind::Changed);
  return download(container) && start();
}

}  // namespace stepwright::run
