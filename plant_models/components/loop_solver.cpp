#include "plant_models/components/loop_solver.h"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plant_models/components/pseudo_transient.h"

namespace stepwright::components {

struct LoopSolver::State {
  const Loop* loop = nullptr;
  Run run = nullptr;
  const void* context = nullptr;
  const Frame* frame = nullptr;
  SUNContext sundials = nullptr;
  N_Vector u = nullptr;
  N_Vector u_scale = nullptr;
  N_Vector f_scale = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* kinsol = nullptr;
  bool solved = true;
  std::vector<double> start;
  std::vector<double> moved;
  std::unique_ptr<PseudoTransient> patient;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (kinsol != nullptr) KINFree(&kinsol);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    for (const N_Vector vector : {u, u_scale, f_scale})
      if (vector != nullptr) N_VDestroy(vector);
    if (sundials != nullptr) SUNContext_Free(&sundials);
  }

  void residual(const double* unknowns, double* f) const {
    for (std::size_t i = 0; i < loop->unknowns.size(); ++i) frame->v[loop->unknowns[i]] = unknowns[i];
    run(context, *loop, *frame);
    for (std::size_t i = 0; i < loop->residuals.size(); ++i) f[i] = frame->v[loop->residuals[i]];
  }
  // Where nothing flows any temperature solves the equations.
  bool is_physical() const {
    constexpr double kHottest = 1e4;  // K
    for (std::size_t i = 0; i < loop->unknowns.size(); ++i) {
      const double temperature = NV_DATA_S(u)[i];
      if (loop->pressure_of[i] >= 0 && (temperature < 0.0 || temperature > kHottest)) return false;
    }
    return true;
  }
  // A step that is too small to matter is an end as well, but not wherever it stops.
  bool nearly_solved() {
    constexpr double kNearly = 1e-8;
    residual(NV_DATA_S(u), moved.data());
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (!(std::abs(moved[i]) <= kNearly * loop->typical_residual[i])) return false;
    return true;
  }
};

namespace {

constexpr double kResidualTolerance = 1e-10;  // of typical ones
constexpr double kStepTolerance = 1e-15;

}  // namespace

// The callbacks know the state by its pointer only.
struct LoopCallbacks {
  template <typename State>
  static int residual(N_Vector u, N_Vector f, void* state) {
    static_cast<State*>(state)->residual(NV_DATA_S(u), NV_DATA_S(f));
    const auto* values = NV_DATA_S(f);
    double finite = 0.0;
    for (sunindextype i = 0; i < NV_LENGTH_S(f); ++i) finite += 0.0 * values[i];
    return finite == 0.0 ? 0 : 1;
  }

  // By differences on both sides: at the kink of a check valve one of them sees nothing, and the steeper one
  // counts. Where nothing flows whatever the pressure is, any pressure will do: a little of the diagonal
  // keeps the matrix regular and changes no solution.
  template <typename State>
  static int jacobian(N_Vector u, N_Vector f, SUNMatrix matrix, void* pointer, N_Vector, N_Vector) {
    auto& s = *static_cast<State*>(pointer);
    double* unknowns = NV_DATA_S(u);
    const auto size = static_cast<std::size_t>(NV_LENGTH_S(u));
    for (std::size_t j = 0; j < size; ++j) {
      const auto column = static_cast<sunindextype>(j);
      const double kept = unknowns[j];
      const double length = 1e-8 * std::max(std::abs(kept), 1e-3 * s.loop->typical[j]);
      for (const double step : {length, -length}) {
        unknowns[j] = kept + step;
        s.residual(unknowns, s.moved.data());
        for (std::size_t i = 0; i < size; ++i) {
          double& entry = SM_ELEMENT_D(matrix, static_cast<sunindextype>(i), column);
          const double slope = (s.moved[i] - NV_DATA_S(f)[i]) / step;
          if (step > 0.0 || std::abs(slope) > std::abs(entry)) entry = slope;
        }
      }
      unknowns[j] = kept;
      const double little = 1e-12 * s.loop->typical_residual[j] / s.loop->typical[j];
      SM_ELEMENT_D(matrix, column, column) += SM_ELEMENT_D(matrix, column, column) > 0.0 ? little : -little;
    }
    return 0;
  }
};

LoopSolver::LoopSolver(std::unique_ptr<State> state) : state_(std::move(state)) {}
LoopSolver::~LoopSolver() = default;
LoopSolver::LoopSolver(LoopSolver&&) noexcept = default;
LoopSolver& LoopSolver::operator=(LoopSolver&&) noexcept = default;

result::Result<LoopSolver> LoopSolver::create(const Loop& loop, Run run, const void* context) {
  auto state = std::make_unique<State>();
  State& s = *state;
  s.loop = &loop;
  s.run = run;
  s.context = context;
  const std::size_t size = loop.unknowns.size();
  const auto n = static_cast<sunindextype>(size);
  s.start.assign(size, 0.0);
  s.moved.assign(size, 0.0);
  s.patient = std::make_unique<PseudoTransient>(loop);
  bool ok = SUNContext_Create(nullptr, &s.sundials) == 0;
  ok = ok && (s.u = N_VNew_Serial(n, s.sundials)) != nullptr;
  ok = ok && (s.u_scale = N_VNew_Serial(n, s.sundials)) != nullptr;
  ok = ok && (s.f_scale = N_VNew_Serial(n, s.sundials)) != nullptr;
  ok = ok && (s.matrix = SUNDenseMatrix(n, n, s.sundials)) != nullptr;
  ok = ok && (s.linear = SUNLinSol_Dense(s.u, s.matrix, s.sundials)) != nullptr;
  ok = ok && (s.kinsol = KINCreate(s.sundials)) != nullptr;
  for (std::size_t i = 0; ok && i < size; ++i) {
    NV_DATA_S(s.u_scale)[i] = 1.0 / loop.typical[i];
    NV_DATA_S(s.f_scale)[i] = 1.0 / loop.typical_residual[i];
  }
  const auto quiet = [](int, const char*, const char*, char*, void*) {};
  ok = ok && KINSetErrHandlerFn(s.kinsol, quiet, nullptr) == KIN_SUCCESS;
  ok = ok && KINSetUserData(s.kinsol, &s) == KIN_SUCCESS;
  ok = ok && KINInit(s.kinsol, LoopCallbacks::residual<State>, s.u) == KIN_SUCCESS;
  ok = ok && KINSetLinearSolver(s.kinsol, s.linear, s.matrix) == KIN_SUCCESS;
  ok = ok && KINSetJacFn(s.kinsol, LoopCallbacks::jacobian<State>) == KIN_SUCCESS;
  ok = ok && KINSetFuncNormTol(s.kinsol, kResidualTolerance) == KIN_SUCCESS;
  ok = ok && KINSetScaledStepTol(s.kinsol, kStepTolerance) == KIN_SUCCESS;
  ok = ok && KINSetNumMaxIters(s.kinsol, 200) == KIN_SUCCESS;
  ok = ok && KINSetMaxSetupCalls(s.kinsol, 1) == KIN_SUCCESS;
  ok = ok && KINSetMaxNewtonStep(s.kinsol, 1e6) == KIN_SUCCESS;
  if (!ok)
    return result::fail(
        "C0331", {}, "the loop through " + loop.names + " cannot be solved: SUNDIALS refused the settings");
  for (std::size_t i = 0; i < size; ++i) s.start[i] = loop.start[i];
  return LoopSolver(std::move(state));
}

bool LoopSolver::solved() const {
  return state_->solved;
}

bool LoopSolver::solve(const Frame& frame) {
  State& s = *state_;
  s.frame = &frame;
  // A line search may stop at a kink that whole steps get over.
  bool& solved = s.solved;
  solved = false;
  for (const int strategy : {KIN_LINESEARCH, KIN_NONE}) {
    std::copy(s.start.begin(), s.start.end(), NV_DATA_S(s.u));
    const int flag = KINSol(s.kinsol, s.u, strategy, s.u_scale, s.f_scale);
    solved = flag >= 0 && (flag != KIN_STEP_LT_STPTOL || s.nearly_solved()) && s.is_physical();
    if (solved) break;
  }
  if (!solved) {
    std::copy(s.start.begin(), s.start.end(), NV_DATA_S(s.u));
    solved = s.patient->solve([&s](const double* unknowns, double* f) { s.residual(unknowns, f); },
                              NV_DATA_S(s.u));
  }
  if (!solved) {
    for (const std::uint32_t unknown : s.loop->unknowns)
      frame.v[unknown] = std::numeric_limits<double>::quiet_NaN();
    s.run(s.context, *s.loop, frame);
    return false;
  }
  s.residual(NV_DATA_S(s.u), s.moved.data());
  if (!frame.sampling) std::copy_n(NV_DATA_S(s.u), s.start.size(), s.start.begin());
  return true;
}

}  // namespace stepwright::components
