#pragma once

// A second way to the solution of a loop, for where Newton's method does not get from where it begins:
// pseudo-transient continuation (Kelley and Keyes, "Convergence analysis of pseudo-transient continuation",
// SIAM J. Numer. Anal. 35, 1998). Each junction is given a content that what flows in adds to; implicit steps
// of growing length lead to rest. What flows falls with the pressure at a junction, so that this ends
// wherever there is a solution: a turbulent pipe without flow and a valve that is shut stop Newton's method,
// not this. Temperatures follow from the flows, in which they are linear.
//
// Thread rule: one thread at a time; solve() allocates nothing.

#include <functional>
#include <memory>

#include "plant_models/components/model.h"

namespace stepwright::components {

class PseudoTransient {
 public:
  // `f`: what is left at `unknowns`.
  using Residual = std::function<void(const double* unknowns, double* f)>;

  // The loop must outlive it.
  explicit PseudoTransient(const Loop& loop);
  ~PseudoTransient();
  PseudoTransient(PseudoTransient&&) noexcept;
  PseudoTransient& operator=(PseudoTransient&&) noexcept;

  // From where `unknowns` are. False if it has not come to rest; `unknowns` are then where it stopped.
  bool solve(const Residual& residual, double* unknowns);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::components
