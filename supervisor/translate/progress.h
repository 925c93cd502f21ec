#pragma once

// Progress of a plan: the actions that are done, from the step bits of its running chart. One snapshot is
// enough: a token in a step proves that everything ordered before it is done, so a supervisor that was
// restarted reads on where the old one stopped.
//
// Values and a pure function; any thread.
//
//   Progress now = progress(translation, active);
//   now.actions[3] == ActionState::Done

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/translate/translation.h"

namespace stepwright::translate {

enum class ActionState : std::uint8_t { Pending, Active, Done, Failed };

struct Progress {
  std::vector<ActionState> actions;       // Failed: could not start, or began and did not end
  std::vector<std::size_t> failed_steps;  // indices into Translation::steps
  bool finished = false;                  // DONE is active
  // Active actions whose completion was observed: only their rest runs. Interrupted now, they have done what
  // they were for. Shorter than `actions`: the others are not.
  std::vector<bool> resting;

  std::vector<bool> done() const;
  // The same, with those that rest.
  std::vector<bool> completed() const;
  bool rests(std::size_t action) const { return action < resting.size() && resting[action]; }
};

// `active[i]` is the bit of translation.steps[i]. Pure function.
Progress progress(const Translation& translation, const std::vector<bool>& active);

}  // namespace stepwright::translate
