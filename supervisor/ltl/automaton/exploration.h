#pragma once

// All states of a formula in progress, up to a bound. Private to this library.

#include <unordered_map>
#include <vector>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/automaton/progression.h"
#include "supervisor/ltl/automaton/reach.h"

namespace stepwright::ltl {

class Exploration {
 public:
  Exploration(Progression& progression, const BuildOptions& options);

  // False when a bound was met.
  bool run();
  bool too_many_states() const { return states_.size() > options_.most_states; }

  const std::vector<Progression::State>& states() const { return states_; }
  Guards& guards() { return guards_; }
  const std::vector<Guard>& edges() const { return edges_; }

  // By allowed letters.
  Reach reach() const;

 private:
  std::uint32_t number(Progression::State state);
  Guard guard(Diagram::Node node);
  Guard guard_of_single_letters(Progression::State state);

  Progression& progression_;
  const BuildOptions& options_;
  Progression::State forbidden_ = Diagram::kFalse;  // what follows a letter that is not allowed
  bool restricted_ = false;
  std::vector<Progression::State> states_;
  std::unordered_map<Progression::State, std::uint32_t> numbers_;
  Guards guards_;
  std::unordered_map<Diagram::Node, Guard> known_;
  std::vector<Guard> edges_;
};

}  // namespace stepwright::ltl
