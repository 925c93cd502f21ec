#include "plant_models/ode/cvode_solver.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "plant_models/ode/jacobian.h"
#include "plant_models/ode/subnormals.h"

namespace stepwright::ode {

// Everything that SUNDIALS made, freed in the reverse order.
struct CvodeSolver::State {
  const OdeSystem* system = nullptr;
  Callbacks callbacks;  // what SUNDIALS hands to them
  double first_step_s = 0.0;
  SUNContext context = nullptr;
  N_Vector y = nullptr;        // solution at `time`
  N_Vector scratch = nullptr;  // absolute tolerances first, then dense output
  SUNNonlinearSolver iteration = nullptr;
  std::unique_ptr<Jacobian> jacobian;  // of an implicit method
  void* cvode = nullptr;
  double time = 0.0;
  double oldest = 0.0;  // begin of the last step
  bool failed = false;
  CvodeStatistics before_restart;  // CVODE counts from its last restart only
  std::vector<int> roots;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (cvode != nullptr) CVodeFree(&cvode);
    if (iteration != nullptr) SUNNonlinSolFree(iteration);
    jacobian.reset();
    if (scratch != nullptr) N_VDestroy(scratch);
    if (y != nullptr) N_VDestroy(y);
    if (context != nullptr) SUNContext_Free(&context);
  }
};

namespace {

// Without a least step CVODE creeps up to a singularity for ever instead of reporting a failure.
constexpr double kMinStepS = 1e-9;

std::span<double> values(N_Vector vector) {
  return {NV_DATA_S(vector), static_cast<std::size_t>(NV_LENGTH_S(vector))};
}

int call_derivative(realtype t, N_Vector y, N_Vector dydt, void* user) {
  static_cast<const Callbacks*>(user)->system->derivative(t, values(y), values(dydt));
  // CVODE's error test lets NaN pass, and a plant full of NaN would look healthy.
  double finite = 0.0;
  for (const double slope : values(dydt)) finite += 0.0 * slope;
  constexpr int kTryShorterStep = 1;
  return finite == 0.0 ? 0 : kTryShorterStep;
}

int call_roots(realtype t, N_Vector y, realtype* g, void* user) {
  const OdeSystem* ode = static_cast<const Callbacks*>(user)->system;
  ode->roots(t, values(y), {g, ode->root_count()});
  return 0;
}

// The return codes say all that we report; without a handler SUNDIALS would print.
void ignore_message(int, const char*, const char*, char*, void*) {}

std::string check(const OdeSystem& system, std::span<const double> y0, const CvodeSettings& settings) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (y0.empty() || y0.size() != system.state_size()) return "the start state has the wrong size";
  if (settings.absolute_tolerance.size() != y0.size()) return "one absolute tolerance per state is needed";
  if (!std::all_of(y0.begin(), y0.end(), [](double x) { return std::isfinite(x); })) {
    return "the start state is not finite";
  }
  const auto& tolerances = settings.absolute_tolerance;
  if (!std::all_of(tolerances.begin(), tolerances.end(), positive)) {
    return "the absolute tolerances must be positive";
  }
  if (!positive(settings.relative_tolerance)) return "the relative tolerance must be positive";
  const double shortest_s = std::min(settings.first_step_s, settings.max_step_s);
  if (!positive(settings.first_step_s) || !positive(settings.max_step_s) || shortest_s < kMinStepS) {
    return "the steps must be at least a nanosecond";
  }
  const int highest = settings.implicit ? 5 : 12;
  if (settings.max_order < 1 || settings.max_order > highest)
    return "the order must lie in 1.." + std::to_string(highest);
  return {};
}

}  // namespace

CvodeSolver::CvodeSolver(std::unique_ptr<State> state) : state_(std::move(state)) {}
CvodeSolver::~CvodeSolver() = default;
CvodeSolver::CvodeSolver(CvodeSolver&&) noexcept = default;
CvodeSolver& CvodeSolver::operator=(CvodeSolver&&) noexcept = default;

result::Result<CvodeSolver> CvodeSolver::create(const OdeSystem& system, std::span<const double> y0,
                                                double t0_s, const CvodeSettings& settings) {
  if (const std::string wrong = check(system, y0, settings); !wrong.empty()) {
    return result::fail("C0331", {}, "the solver cannot be made: " + wrong);
  }
  auto state = std::make_unique<State>();
  State& s = *state;
  s.system = &system;
  s.callbacks.system = &system;
  s.first_step_s = settings.first_step_s;
  s.time = s.oldest = t0_s;
  s.roots.resize(system.root_count());
  bool ok = SUNContext_Create(nullptr, &s.context) == 0;
  const auto size = static_cast<sunindextype>(y0.size());
  ok = ok && (s.y = N_VNew_Serial(size, s.context)) != nullptr;
  ok = ok && (s.scratch = N_VNew_Serial(size, s.context)) != nullptr;
  s.iteration = !ok                 ? nullptr
                : settings.implicit ? SUNNonlinSol_Newton(s.y, s.context)
                                    : SUNNonlinSol_FixedPoint(s.y, 0, s.context);
  ok = ok && s.iteration != nullptr;
  ok = ok && (s.cvode = CVodeCreate(settings.implicit ? CV_BDF : CV_ADAMS, s.context)) != nullptr;
  ok = ok && CVodeSetErrHandlerFn(s.cvode, ignore_message, nullptr) == CV_SUCCESS;
  if (ok) {
    std::copy(y0.begin(), y0.end(), NV_DATA_S(s.y));
    std::copy(settings.absolute_tolerance.begin(), settings.absolute_tolerance.end(), NV_DATA_S(s.scratch));
  }
  ok = ok && CVodeInit(s.cvode, call_derivative, t0_s, s.y) == CV_SUCCESS;
  ok = ok && CVodeSVtolerances(s.cvode, settings.relative_tolerance, s.scratch) == CV_SUCCESS;
  ok = ok && CVodeSetUserData(s.cvode, &s.callbacks) == CV_SUCCESS;
  ok = ok && CVodeSetNonlinearSolver(s.cvode, s.iteration) == CV_SUCCESS;
  if (ok && settings.implicit) {
    s.jacobian = Jacobian::attach(system, s.y, s.cvode, s.context, settings.absolute_tolerance);
    s.callbacks.jacobian = s.jacobian.get();
    ok = s.jacobian != nullptr;
  }
  ok = ok && CVodeSetMaxOrd(s.cvode, settings.max_order) == CV_SUCCESS;
  ok = ok && CVodeSetMaxStep(s.cvode, settings.max_step_s) == CV_SUCCESS;
  ok = ok && CVodeSetMinStep(s.cvode, kMinStepS) == CV_SUCCESS;
  ok = ok && CVodeSetInitStep(s.cvode, settings.first_step_s) == CV_SUCCESS;
  ok = ok && CVodeRootInit(s.cvode, static_cast<int>(system.root_count()), call_roots) == CV_SUCCESS;
  ok = ok && CVodeSetNoInactiveRootWarn(s.cvode) == CV_SUCCESS;
  if (!ok) return result::fail("C0331", {}, "the solver cannot be made: SUNDIALS refused the settings");
  return CvodeSolver(std::move(state));
}

StepOutcome CvodeSolver::step() {
  State& s = *state_;
  if (s.failed) return StepOutcome::Failed;
  const SubnormalsFlushed flushed;
  double reached = s.time;
  // In one-step mode the wanted time only tells the direction.
  const int flag = CVode(s.cvode, s.time + 1.0, s.y, &reached, CV_ONE_STEP);
  if (flag < 0) {
    s.failed = true;
    return StepOutcome::Failed;
  }
  s.oldest = s.time;
  s.time = reached;
  if (flag != CV_ROOT_RETURN) return StepOutcome::Stepped;
  CVodeGetRootInfo(s.cvode, s.roots.data());
  return StepOutcome::Root;
}

double CvodeSolver::time() const {
  return state_->time;
}

bool CvodeSolver::state_at(double t_s, std::span<double> y) const {
  const State& s = *state_;
  assert(y.size() == s.system->state_size());
  if (!(t_s >= s.oldest && t_s <= s.time)) return false;
  if (t_s == s.time && !s.failed) {
    std::copy_n(NV_DATA_S(s.y), y.size(), y.begin());
    return true;
  }
  if (CVodeGetDky(s.cvode, t_s, 0, s.scratch) != CV_SUCCESS) return false;
  std::copy_n(NV_DATA_S(s.scratch), y.size(), y.begin());
  return true;
}

std::span<const int> CvodeSolver::roots() const {
  return state_->roots;
}

bool CvodeSolver::restart(double t_s, std::span<const double> y) {
  State& s = *state_;
  assert(y.size() == s.system->state_size());
  if (s.failed) return false;
  const CvodeStatistics so_far = statistics();
  std::copy(y.begin(), y.end(), NV_DATA_S(s.y));
  s.failed =
      CVodeReInit(s.cvode, t_s, s.y) != CV_SUCCESS || CVodeSetInitStep(s.cvode, s.first_step_s) != CV_SUCCESS;
  if (s.failed) return false;
  s.before_restart = so_far;
  s.before_restart.restarts += 1;
  s.time = s.oldest = t_s;
  return true;
}

CvodeStatistics CvodeSolver::statistics() const {
  const State& s = *state_;
  long steps = 0;
  long derivative_calls = 0;
  long failed_tests = 0;
  long root_calls = 0;
  CVodeGetNumSteps(s.cvode, &steps);
  CVodeGetNumRhsEvals(s.cvode, &derivative_calls);
  CVodeGetNumErrTestFails(s.cvode, &failed_tests);
  CVodeGetNumGEvals(s.cvode, &root_calls);
  CvodeStatistics total = s.before_restart;
  total.steps += steps;
  total.derivative_calls += derivative_calls;
  total.failed_error_tests += failed_tests;
  total.root_calls += root_calls;
  return total;
}

}  // namespace stepwright::ode
