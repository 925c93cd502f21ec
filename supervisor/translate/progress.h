#pragma once

// Which actions of a plan are done, from the step bits of its running chart.
//
//   Progress progress(translation);
//   progress.update(active_steps);        // at every step event, in order
//   progress.state(3) == ActionState::Done

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/translate/translation.h"

namespace stepwright::translate {

enum class ActionState : std::uint8_t { Pending, Active, Done, Failed };

// Not thread-safe. Requires every step event since the start, or a start from a single snapshot, from which
// it infers what must be done by the orderings and the waiting tokens.
class Progress {
 public:
  explicit Progress(const Translation& translation);

  // `active[i]` belongs to translation.steps[i].
  void update(const std::vector<bool>& active);

  ActionState state(std::size_t action) const { return states_[action]; }
  std::vector<bool> done() const;
  std::vector<std::size_t> active() const;
  std::optional<std::size_t> failed_step() const { return failed_step_; }  // index into steps
  bool finished() const { return finished_; }                              // DONE is active

 private:
  std::vector<StepInfo> steps_;
  std::vector<model::Ordering> orderings_;
  std::vector<std::vector<std::size_t>> before_step_;  // actions that a token in this step proves done
  std::vector<ActionState> states_;
  std::optional<std::size_t> failed_step_;
  bool finished_ = false;
};

}  // namespace stepwright::translate
