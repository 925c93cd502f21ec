#include "plant_models/ode/jacobian.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace stepwright::ode {
namespace {

constexpr std::size_t kMostDense = 40;  // states: beyond, the sparse matrix is cheaper

std::span<double> values(N_Vector vector) {
  return {NV_DATA_S(vector), static_cast<std::size_t>(NV_LENGTH_S(vector))};
}

int call_jacobian(realtype t, N_Vector y, N_Vector dydt, SUNMatrix matrix, void* user, N_Vector moved,
                  N_Vector changed, N_Vector) {
  const auto* callbacks = static_cast<const Callbacks*>(user);
  callbacks->jacobian->fill(*callbacks->system, t, y, dydt, matrix, moved, changed);
  return 0;
}

}  // namespace

Jacobian::~Jacobian() {
  if (linear_ != nullptr) SUNLinSolFree(linear_);
  if (matrix_ != nullptr) SUNMatDestroy(matrix_);
}

std::unique_ptr<Jacobian> Jacobian::attach(const OdeSystem& system, N_Vector y, void* cvode,
                                           SUNContext context,
                                           const std::vector<double>& absolute_tolerance) {
  std::unique_ptr<Jacobian> made(new Jacobian());
  const auto size = NV_LENGTH_S(y);
  made->tolerance_ = absolute_tolerance;
  if (static_cast<std::size_t>(size) > kMostDense) {
    const auto rows = system.dependencies();
    made->columns_.resize(rows.size());
    for (std::uint32_t row = 0; row < rows.size(); ++row)
      for (const std::uint32_t column : rows[row]) made->columns_[column].push_back(row);
    if (!rows.empty()) return made->attach_sparse(y, cvode, context) ? std::move(made) : nullptr;
    made->linear_ = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 0, context);
  } else {
    made->matrix_ = SUNDenseMatrix(size, size, context);
    if (made->matrix_ != nullptr) made->linear_ = SUNLinSol_Dense(y, made->matrix_, context);
  }
  const bool ok =
      made->linear_ != nullptr && CVodeSetLinearSolver(cvode, made->linear_, made->matrix_) == CV_SUCCESS;
  return ok ? std::move(made) : nullptr;
}

bool Jacobian::attach_sparse(N_Vector y, void* cvode, SUNContext context) {
  // Newton's matrix has the diagonal in any case.
  std::size_t entries = 0;
  for (std::uint32_t column = 0; column < columns_.size(); ++column) {
    auto& rows = columns_[column];
    const auto place = std::lower_bound(rows.begin(), rows.end(), column);
    if (place == rows.end() || *place != column) rows.insert(place, column);
    entries += rows.size();
  }
  find_groups(columns_.size());
  const auto size = NV_LENGTH_S(y);
  matrix_ = SUNSparseMatrix(size, size, static_cast<sunindextype>(entries), CSC_MAT, context);
  if (matrix_ != nullptr) linear_ = SUNLinSol_KLU(y, matrix_, context);
  return linear_ != nullptr && CVodeSetLinearSolver(cvode, linear_, matrix_) == CV_SUCCESS &&
         CVodeSetJacFn(cvode, call_jacobian) == CV_SUCCESS;
}

// Each column into the first group that none of its rows is in yet.
void Jacobian::find_groups(std::size_t size) {
  std::vector<std::vector<bool>> taken;
  for (std::uint32_t column = 0; column < columns_.size(); ++column) {
    const auto free = [&](const std::vector<bool>& rows) {
      return std::none_of(columns_[column].begin(), columns_[column].end(),
                          [&](std::uint32_t row) { return rows[row]; });
    };
    auto group = static_cast<std::size_t>(std::find_if(taken.begin(), taken.end(), free) - taken.begin());
    if (group == taken.size()) {
      taken.emplace_back(size, false);
      groups_.emplace_back();
    }
    for (const std::uint32_t row : columns_[column]) taken[group][row] = true;
    groups_[group].push_back(column);
  }
}

void Jacobian::fill(const OdeSystem& system, double t, N_Vector y, N_Vector dydt, SUNMatrix matrix,
                    N_Vector moved, N_Vector changed) const {
  sunindextype* const pointers = SUNSparseMatrix_IndexPointers(matrix);
  sunindextype* const rows = SUNSparseMatrix_IndexValues(matrix);
  realtype* const data = SUNSparseMatrix_Data(matrix);
  sunindextype at = 0;
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    pointers[column] = at;
    for (const std::uint32_t row : columns_[column]) rows[at++] = static_cast<sunindextype>(row);
  }
  pointers[columns_.size()] = at;
  const auto step = [&](std::uint32_t column) {
    return std::max(1.5e-8 * std::abs(values(y)[column]), tolerance_[column]);
  };
  for (const auto& group : groups_) {
    std::copy(values(y).begin(), values(y).end(), values(moved).begin());
    for (const std::uint32_t column : group) values(moved)[column] += step(column);
    system.derivative(t, values(moved), values(changed));
    for (const std::uint32_t column : group) {
      const double size = values(moved)[column] - values(y)[column];
      for (std::size_t i = 0; i < columns_[column].size(); ++i) {
        const std::uint32_t row = columns_[column][i];
        data[pointers[column] + static_cast<sunindextype>(i)] =
            (values(changed)[row] - values(dydt)[row]) / size;
      }
    }
  }
}

}  // namespace stepwright::ode
