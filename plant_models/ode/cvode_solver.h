#pragma once

// CVODE (SUNDIALS 6.4) behind a move-only handle: variable-order Adams with fixed-point iteration, dense
// output, root-finding. The solver picks its own steps, so that how often a caller looks at the state
// changes nothing: step until time() has passed the wanted instant, then ask state_at().
//
// Adams with fixed-point iteration combines derivatives linearly, so it keeps every linear invariant of
// the system (the total liquid) to rounding; a Newton iteration would keep it to its tolerance only. It
// suits systems whose fastest time constant is not far below the output interval. Others are solved
// implicitly: with a dense Jacobian, or by GMRES without one where there are many states.
//
// Thread rule: one thread at a time. After create() no call allocates. The system must outlive the solver
// and must not move.
//
//   auto solver = CvodeSolver::create(system, y0, 0.0, {.absolute_tolerance = tolerances});
//   while (solver->time() < t) if (solver->step() != StepOutcome::Stepped) ...
//   solver->state_at(t, y);

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plant_models/ode/ode_system.h"
#include "runtime/ground/result/result.h"

namespace stepwright::ode {

struct CvodeSettings {
  double relative_tolerance = 1e-6;
  std::vector<double> absolute_tolerance;  // one per state, > 0
  double first_step_s = 1e-3;              // tried after a restart; the error test may shorten it
  double max_step_s = 0.1;                 // bounds what a root function can do unseen
  int max_order = 5;                       // 1..12; of an implicit method at most 5
  // Backward differentiation with Newton's method for stiff systems, instead of Adams. Keeps linear
  // invariants to its tolerance only.
  bool implicit = false;
};

enum class StepOutcome : std::uint8_t {
  Stepped,  // time() has advanced
  Root,     // time() has advanced to a root; see roots()
  Failed,   // no further step is possible; the last state stays readable
};

// Counts of the solver's work since create().
struct CvodeStatistics {
  std::int64_t steps = 0;
  std::int64_t derivative_calls = 0;
  std::int64_t root_calls = 0;
  std::int64_t restarts = 0;
  std::int64_t failed_error_tests = 0;
};

class CvodeSolver {
 public:
  // Fails with C0331 when sizes or settings do not fit, or SUNDIALS refuses.
  [[nodiscard]] static result::Result<CvodeSolver> create(const OdeSystem& system, std::span<const double> y0,
                                                          double t0_s, const CvodeSettings& settings);
  ~CvodeSolver();
  CvodeSolver(CvodeSolver&&) noexcept;
  CvodeSolver& operator=(CvodeSolver&&) noexcept;

  // Makes one internal step, at most to the next root.
  StepOutcome step();

  // How far the solution is known, in seconds.
  double time() const;

  // The solution at t, which lies within the last step: not after time(), not before time() was when that
  // step began. Writes nothing and returns false elsewhere.
  bool state_at(double t_s, std::span<double> y) const;

  // After StepOutcome::Root: per root function +1 (it rose through zero), -1 (it fell), 0 (no root).
  std::span<const int> roots() const;

  // Goes on from another state, or after the derivative has jumped. Returns false if SUNDIALS refuses.
  bool restart(double t_s, std::span<const double> y);

  CvodeStatistics statistics() const;

 private:
  struct State;
  explicit CvodeSolver(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::ode
