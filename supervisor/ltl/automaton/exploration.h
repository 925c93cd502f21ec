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
  bool too_many_states() const { return _states.size() > _options.most_states; }

  const std::vector<Progression::State>& states() const { return _states; }
  Guards& guards() { return _guards; }
  const std::vector<Guard>& edges() const { return _edges; }

  // By allowed letters.
  Reach reach() const;

 private:
  std::uint32_t number(Progression::State state);
  Guard guard(Diagram::Node node);
  Guard guard_of_single_letters(Progression::State state);

  Progression& _progression;
  const BuildOptions& _options;
  Progression::State _forbidden = Diagram::kFalse;  // what follows a letter that is not allowed
  bool _restricted = false;
  std::vector<Progression::State> _states;
  std::unordered_map<Progression::State, std::uint32_t> _numbers;
  Guards _guards;
  std::unordered_map<Diagram::Node, Guard> _known;
  std::vector<Guard> _edges;
};

}  // namespace stepwright::ltl
