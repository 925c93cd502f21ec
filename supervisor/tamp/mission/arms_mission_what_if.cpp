// Where a plan for another order would begin, and such plans, which nobody drives.

#include <algorithm>
#include <utility>

#include "supervisor/run/internal/what_if_json.h"
#include "supervisor/tamp/mission/arms_episode.h"
#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using run::ActionState;
using run::internal::json;

namespace {

// What can be said of where things stand.
json facts_of(const scene::RobotCell& cell, const scene::GeometricState& state) {
  json facts = json::array();
  const auto add = [&](const Wanted& each) {
    if (!is_met(cell, state, each)) return;
    const std::string& place =
        each.surface >= 0 ? cell.surfaces[at(each.surface)].name : cell.things[at(each.on)].name;
    facts.push_back("(in " + cell.things[at(each.thing)].name + " " + place + ")");
  };
  for (int thing = 0; thing < static_cast<int>(cell.things.size()); ++thing) {
    for (int surface = 0; surface < static_cast<int>(cell.surfaces.size()); ++surface)
      add({thing, surface, -1});
    for (int on = 0; on < static_cast<int>(cell.things.size()); ++on)
      if (on != thing && cell.things[at(on)].carries) add({thing, -1, on});
  }
  return facts;
}

const char* state_of(const result::Diagnostics& why) {
  const std::string& code = why.front().code;
  if (code == kNoPlan) return "no_plan";
  return code == kNotFound || code == kNoWayHome ? "exhausted" : "failed";
}

}  // namespace

// While a plan is driven, things are where the actions that run will have put them.
ArmsOutlook ArmsMission::outlook() const {
  ArmsOutlook made{
      .goal = order_.goal, .state = initial_state(planning_.cell()), .strangers = sight_.strangers};
  for (std::size_t k = 0; k < believed_.size(); ++k) made.state.things[k].pose = believed_[k];
  if (!driven_ || record_.episodes.empty() || record_.phase != run::Phase::Executing) return made;
  const auto& actions = record_.episodes.back().actions;
  double begun_s = 0.0;
  for (const run::ActionRecord& each : actions) {
    if (each.state == ActionState::Pending)
      ++made.steps_left;
    else
      begun_s = std::max(begun_s, each.planned_finish_s);
    made.ahead = made.ahead || each.state == ActionState::Active;
  }
  for (std::size_t k = actions.size(); k-- > 0;) {
    const scene::PlannedAction& each = driven_->plan.actions[k];
    const bool held = std::ranges::find(held_, each.what.thing) != held_.end();
    if (each.what.kind == scene::ActionKind::Place && held && actions[k].state != ActionState::Done)
      made.state.things[at(each.what.thing)].pose = each.pose;
  }
  made.left_s = std::max(0.0, driven_->schedule.makespan_s - begun_s);
  return made;
}

void ArmsMission::note_outlook() {
  ArmsOutlook made = outlook();
  made.text = run::internal::text_of(
      {{"goal", made.goal}, {"facts", facts_of(planning_.cell(), made.state)}, {"fluents", json::object()}});
  const std::lock_guard lock(outlook_mutex_);
  outlook_ = std::move(made);
  outlook_is_new_ = true;
}

std::optional<std::string> ArmsMission::new_outlook() {
  const std::lock_guard lock(outlook_mutex_);
  const std::uint64_t revision = what_if_.revision();
  if (!std::exchange(outlook_is_new_, false) && revision == told_what_if_) return std::nullopt;
  told_what_if_ = revision;
  json told = json::parse(outlook_.text);
  told["what_if"] = json::parse(what_if_.answer());
  return run::internal::text_of(told);
}

// Of an order by its name, of a goal, or of the order that there is.
result::Result<void> ArmsMission::ask_what_if(const std::string& id, std::string goal) {
  ArmsOutlook from;
  {
    const std::lock_guard lock(outlook_mutex_);
    from = outlook_;
  }
  if (goal.empty()) goal = from.goal;
  auto order = planning_.order(goal);
  if (!order) return result::forward(order);
  const run::WhatIfAsked asked{id, std::move(goal), from.ahead};
  return what_if_.ask(asked, [this, order = *std::move(order), from = std::move(from)](
                                 const std::atomic<bool>& cancel) { return sketch(order, from, cancel); });
}

// In the thread of the question: nothing of the run is looked at.
std::string ArmsMission::sketch(const ArmsOrder& order, const ArmsOutlook& from,
                                const std::atomic<bool>& cancel) const {
  const auto prepared = planning_.plan({.order = &order,
                                        .state = from.state,
                                        .strangers = from.strangers,
                                        .only_looked_at = true,
                                        .cancel = &cancel});
  json told = {{"state", cancel     ? "cancelled"
                         : prepared ? "planned"
                                    : state_of(prepared.error())},
               {"running", nullptr}};
  if (cancel)
    told["reason"] = "cancelled";
  else if (prepared)
    told["plan"] = run::internal::plan_json(episode_of(*prepared), 0.0);
  else
    told["reason"] = result::to_string(prepared.error());
  if (from.steps_left > 0)
    told["running"] = run::internal::worth_json({.steps = from.steps_left,
                                                 .cost = from.left_s,
                                                 .cost_ahead = from.left_s,
                                                 .makespan_s = from.left_s});
  return run::internal::text_of(told);
}

}  // namespace stepwright::tamp::mission
