#include "supervisor/translate/progress.h"

namespace stepwright::translate {

std::vector<bool> Progress::done() const {
  std::vector<bool> flags;
  for (const ActionState state : actions) flags.push_back(state == ActionState::Done);
  return flags;
}

std::vector<bool> Progress::completed() const {
  std::vector<bool> flags = done();
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = flags[i] || rests(i);
  return flags;
}

Progress progress(const Translation& translation, const std::vector<bool>& active) {
  Progress now;
  now.actions.assign(translation.changes.size(), ActionState::Pending);
  now.resting.assign(translation.changes.size(), false);
  for (std::size_t i = 0; i < translation.steps.size(); ++i) {
    const StepInfo& step = translation.steps[i];
    if (!active[i]) continue;
    for (const std::size_t action : step.after) now.actions[action] = ActionState::Done;
    if (step.kind == StepKind::Done) now.finished = true;
    if (step.kind == StepKind::Failed) now.failed_steps.push_back(i);
    if (!step.action) continue;
    now.resting[*step.action] = step.kind == StepKind::Rest;
    now.actions[*step.action] = step.kind == StepKind::Failed ? ActionState::Failed : ActionState::Active;
  }
  // Orderings lead to larger indices; backwards, one pass makes everything before a done action done.
  for (std::size_t i = translation.orderings.size(); i-- > 0;) {
    const model::Ordering& edge = translation.orderings[i];
    const ActionState later = now.actions[edge.after];
    if (later != ActionState::Pending) now.actions[edge.before] = ActionState::Done;
  }
  return now;
}

}  // namespace stepwright::translate
