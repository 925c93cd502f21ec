#pragma once

// The Jacobian of an implicit method, and what solves with it: dense where there are few states, by CVODE
// itself; sparse where the system says what depends on what, found by differences of several columns at once
// (Curtis, Powell, Reid, "On the estimation of sparse Jacobian matrices", 1974) and solved by KLU; else GMRES
// without a matrix.
//
// Thread rule: that of the solver it belongs to. Private to this folder: it speaks in types of SUNDIALS.

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <memory>
#include <vector>

#include "plant_models/ode/ode_system.h"

namespace stepwright::ode {

class Jacobian;

// The user data of CVODE.
struct Callbacks {
  const OdeSystem* system = nullptr;
  const Jacobian* jacobian = nullptr;  // of an implicit method
};

class Jacobian {
 public:
  // Null if SUNDIALS refuses. The user data of `cvode` are Callbacks.
  static std::unique_ptr<Jacobian> attach(const OdeSystem& system, N_Vector y, void* cvode,
                                          SUNContext context, const std::vector<double>& absolute_tolerance);
  ~Jacobian();
  Jacobian(const Jacobian&) = delete;
  Jacobian& operator=(const Jacobian&) = delete;

  // Fills the sparse matrix at (t, y), where the derivative is `dydt`.
  void fill(const OdeSystem& system, double t, N_Vector y, N_Vector dydt, SUNMatrix matrix, N_Vector moved,
            N_Vector changed) const;

 private:
  Jacobian() = default;
  bool attach_sparse(N_Vector y, void* cvode, SUNContext context);
  void find_groups(std::size_t size);

  std::vector<std::vector<std::uint32_t>> columns_;  // rows of each column with an entry
  std::vector<std::vector<std::uint32_t>> groups_;   // columns that share no row
  std::vector<double> tolerance_;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
};

}  // namespace stepwright::ode
