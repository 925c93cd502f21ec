#pragma once

// Values that depend on each other in the same instant, found by KINSOL (SUNDIALS): Newton's method with a
// line search, from where the last solution was; where that leads nowhere, by pseudo-transient continuation.
//
// Thread rule: one thread at a time; solve() allocates nothing. The loop must outlive it and must not move.

#include <functional>
#include <memory>

#include "plant_models/components/model.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

class LoopSolver {
 public:
  // Works out the steps of the loop in a frame.
  using Run = void (*)(const void* context, const Loop& loop, const Frame& frame);

  // Fails with C0331 when SUNDIALS refuses.
  [[nodiscard]] static result::Result<LoopSolver> create(const Loop& loop, Run run, const void* context);
  ~LoopSolver();
  LoopSolver(LoopSolver&&) noexcept;
  LoopSolver& operator=(LoopSolver&&) noexcept;

  // Sets the unknowns in frame.v and works out the loop with them. A frame of sampling leaves no trace, so
  // that who looks does not change what follows. False if there is no solution: then the unknowns are NaN.
  bool solve(const Frame& frame);
  // Whether the newest solve() has found one.
  bool solved() const;

 private:
  struct State;
  explicit LoopSolver(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::components
