// Events of a described plant: at roots that the solver finds, and where conditions jump through zero.

#include <algorithm>

#include "plant_models/components/model_plant.h"

namespace stepwright::components {
namespace {

constexpr int kMostEvents = 10'000;  // within kEventSpan_s: what is built has fewer
constexpr double kEventSpan_s = 1e-3;
constexpr double kBehindEvent_s = 0.01;  // first steps behind an event, which may be longer than what follows

}  // namespace

bool ModelPlant::run_to(double t_s) {
  if (solver_ == nullptr) return true;
  while (solver_->time() < t_s || (event_pending_ && solver_->time() <= t_s)) {
    if (event_pending_) {
      event_pending_ = false;
      if (is_endless(solver_->time()) || !handle_event()) return false;
      continue;
    }
    const ode::StepOutcome outcome = solver_->step();
    if (outcome == ode::StepOutcome::Failed) return false;
    event_pending_ = outcome == ode::StepOutcome::Root;
    if (solver_->time() - event_at_s_ < kBehindEvent_s && is_unseen()) return false;
  }
  return solver_->state_at(t_s, y_);
}

// Counts one more.
bool ModelPlant::is_endless(double t_s) {
  if (t_s - events_since_s_ > kEventSpan_s) {
    events_ = 0;
    events_since_s_ = t_s;
  }
  endless_events_ = ++events_ > kMostEvents;
  return endless_events_;
}

// Whether an event that has just happened was passed again, within one step.
bool ModelPlant::is_unseen() {
  if (event_pending_ || !solver_->state_at(solver_->time(), y_)) return false;
  const Frame at = frame(solver_->time());
  equations_->evaluate(at);
  for (const std::uint32_t c : model_->with_roots) {
    unseen_event_ = model_->components[c]->passed_unseen(at);
    if (unseen_event_ == nullptr) continue;
    last_event_component_ = c;
    return true;
  }
  return false;
}

// Returns false if the solver cannot go on.
bool ModelPlant::handle_event() {
  const auto signs = solver_->roots();
  const double t_s = solver_->time();
  if (!solver_->state_at(t_s, y_)) return false;
  Frame at = frame(t_s);
  at.dydt = before_.data();
  equations_->evaluate(at);
  equations_->derivatives(at);
  for (const std::uint32_t c : jumping_) model_->components[c]->remember(at);
  Event most = Event::None;
  for (const std::uint32_t c : model_->with_roots) {
    Component& component = *model_->components[c];
    const int* of_component = signs.data() + model_->first_root[c];
    if (std::all_of(of_component, of_component + component.root_count(), [](int sign) { return sign == 0; }))
      continue;
    last_event_component_ = c;
    most = std::max(most, component.handle(at, of_component, y_.data()));
  }
  if (most == Event::None) return true;
  event_at_s_ = t_s;
  settle(t_s);
  const bool jumped = follow_jumps(t_s);
  if (endless_events_) return false;
  if (most == Event::Restart || jumped) return go_on_from(t_s);
  at.dydt = after_.data();
  equations_->evaluate(at);
  equations_->derivatives(at);
  return before_ == after_ || solver_->restart(t_s, y_);
}

// Before a terminal, a fault or an answer of a process changes at now_.
void ModelPlant::remember() {
  if (jumping_.empty() || remembered_at_ == now_) return;
  remembered_at_ = now_;
  const Frame at = frame(static_cast<double>(now_.count()) * 1e-9);
  equations_->evaluate(at);
  for (const std::uint32_t c : jumping_) model_->components[c]->remember(at);
}

// Has the events happen whose conditions have jumped through zero, and those that follow from them, until
// none does. Returns whether there was one.
bool ModelPlant::follow_jumps(double t_s) {
  bool any = false;
  while (!jumping_.empty()) {
    const Frame at = frame(t_s);
    equations_->evaluate(at);
    Event most = Event::None;
    for (const std::uint32_t c : jumping_) {
      const Event event = model_->components[c]->handle_jumps(at, y_.data());
      if (event != Event::None) last_event_component_ = c;
      most = std::max(most, event);
    }
    if (most == Event::None || is_endless(t_s)) return any;
    any = true;
    event_at_s_ = t_s;
    settle(t_s);
  }
  return any;
}

// What was set has changed.
bool ModelPlant::restart(double t_s) {
  settle(t_s);
  const bool jumped = follow_jumps(t_s);
  if (endless_events_) return false;
  if (jumped) return go_on_from(t_s);
  return solver_ == nullptr || solver_->restart(t_s, y_);
}

// From states that may have jumped.
bool ModelPlant::go_on_from(double t_s) {
  if (!solver_->restart(t_s, y_)) return false;
  Frame at = frame(t_s);
  at.dydt = after_.data();
  equations_->derivatives(at);
  for (const std::uint32_t c : model_->with_roots) model_->components[c]->event_done(at);
  return true;
}

}  // namespace stepwright::components
