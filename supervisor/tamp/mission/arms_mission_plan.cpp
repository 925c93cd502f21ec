// From rest to the next plan.

#include <fmt/format.h>

#include <utility>

#include "supervisor/tamp/mission/arms_episode.h"
#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using run::IncidentKind;
using run::Phase;
using run::Response;

// An order that is done is the end; one that is not is planned for from what is seen.
bool ArmsMission::plan_from_rest() {
  const bool retreated = driven_ && driven_->retreats;
  const bool after_a_plan = kind_ == Kind::Follow && reading_.stage == CellStage::Done && !retreated;
  if (!(fault_ ? look_at_fault() : look())) return false;
  for (std::size_t k = 0; k < believed_.size(); ++k)
    if (observed_.state.things[k].holder < 0) believed_[k] = observed_.state.things[k].pose;
  for (std::size_t arm = 0; arm < held_.size(); ++arm) held_[arm] = observed_.state.arms[arm].holds;
  note_outlook();
  if (met_) {
    auto prepared = retreat();
    const std::string arm = planning_.cell().arms[*std::exchange(met_, std::nullopt)].name;
    if (prepared)
      return launch(*std::move(prepared), "the " + arm + " arm goes back by the way that it came");
  }
  return after_a_plan ? judge_end() : plan_order();
}

// One picture shows what an arm has met, whether or not it has all things.
bool ArmsMission::look_at_fault() {
  return picture() && judge_fault() && (observed_.wrong.empty() || look());
}

// A plan has come to its end: the joints and the camera say whether that is the end of the order.
bool ArmsMission::judge_end() {
  if (auto behind = short_of_end()) {
    if (++tries_[behind->about] == 1) return plan_because(behind->cause);
    behind->cause.evidence.push_back("it does not move, that is the 2. time: it is stuck");
    return give_up(behind->cause);
  }
  std::string missing = not_yet(planning_.cell(), observed_.state, order_);
  if (missing.empty() && !at_home()) missing = "all arms at home, with empty hands";
  if (missing.empty()) return plan_order();
  const run::Cause why{IncidentKind::Position, {"the plan has ended, and not yet is " + missing}};
  return ++tries_[missing] > options_.retries ? give_up(why) : plan_because(why);
}

bool ArmsMission::plan_because(const run::Cause& cause) {
  const std::string why = run::sentence_of(cause.evidence);
  record_.replans.push_back({clock_.now_s(), why, {}, false});
  open_incident(cause);
  set_phase(Phase::Replanning, why);
  return plan_order();
}

bool ArmsMission::at_home() const {
  for (std::size_t arm = 0; arm < observed_.state.arms.size(); ++arm) {
    const scene::ArmState& each = observed_.state.arms[arm];
    if (each.holds >= 0 || each.at != planning_.cell().arms[arm].home) return false;
  }
  return true;
}

// What cannot be planned is no end while the arms stand: people can see to it, or want something else.
bool ArmsMission::plan_order() {
  while (true) {
    const scene::RobotCell& cell = planning_.cell();
    for (std::size_t k = 0; k < order_.wanted.size(); ++k)
      record_.goal[k].met = is_met(cell, observed_.state, order_.wanted[k]);
    if (at_home() && not_yet(cell, observed_.state, order_).empty()) {
      decide(Response::GoOn);
      record_.finished_s = clock_.now_s();
      (void)controller_.stop("the order is done");
      set_phase(Phase::Done, fmt::format("the order is done: {}", order_.name));
      return false;
    }
    auto prepared = planning_.plan({.order = &order_,
                                    .state = observed_.state,
                                    .strangers = sight_.strangers,
                                    .back = ways_back(),
                                    .cancel = &abort_});
    if (abort_) return give_up_aborted();
    if (prepared) {
      if (!record_.incidents.empty()) record_.incidents.back().replan_ms = prepared->spent_ms;
      return launch(*std::move(prepared), "the arms work: " + order_.name);
    }
    const std::string reason = result::to_string(prepared.error()) + obstacles();
    if (!stay(reason, IncidentKind::Position) || !look()) return false;
  }
}

bool ArmsMission::launch(PreparedArms prepared, const std::string& message) {
  driven_ = std::move(prepared);
  newest_.clear();
  came_.clear();
  seen_reports_ = 0;
  decide(Response::Replan);
  if (!bring_to_run([&] { return install(*driven_, Kind::Follow); })) return false;
  launch_record();
  show_plan();
  set_phase(Phase::Executing, message);
  note_outlook();
  return true;
}

void ArmsMission::launch_record() {
  run::Episode episode = episode_of(*driven_);
  episode.digest = digest_;
  episode.started_s = clock_.now_s();
  episode.origin = record_.episodes.empty() ? "planned" : "replanned";
  if (record_.episodes.empty()) record_.started_s = record_.finished_s = episode.started_s;
  record_.episodes.push_back(std::move(episode));
}

// False: the runtime is lost, or the run is over.
bool ArmsMission::install(const PreparedArms& prepared, Kind kind) {
  auto reader = ArmsReader::create(prepared.container, planning_.cell(), prepared.program.variables);
  if (!reader) return give_up("the program cannot be read", reader.error());
  return relieve(runs(), prepared.container, [&] {
    reader_ = *std::move(reader);
    kind_ = kind;
    reading_.stage = CellStage::Begins;
  });
}

}  // namespace stepwright::tamp::mission
