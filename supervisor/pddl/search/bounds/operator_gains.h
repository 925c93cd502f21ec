#pragma once

// By how much one application of an operator can bring a comparison nearer to holding, all its effects taken
// together.
//
// Thread rule: immutable.

#include <vector>

#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

// Over all reachable states; never negative, kInfinity if nothing is known.
struct Gains {
  double up = 0.0, down = 0.0;
};

class OperatorGains {
 public:
  explicit OperatorGains(const RelaxedTask& task);

  Gains of(const Mover& mover) const;

  // For every comparison what each operator gains that gains at all; 0 if they differ.
  std::vector<double> alike(bool upwards) const;

 private:
  struct Entry {
    int op;
    Gains gains;
  };

  const RelaxedTask& task_;
  std::vector<std::vector<Entry>> gains_;  // by comparison; operators ascending
};

}  // namespace stepwright::pddl
