#include "supervisor/tamp/intervals/network/linear_program.h"

#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <cmath>

namespace stepwright::tamp {
namespace {

constexpr double kTolerance = 1e-9;  // of bounds and rows, in their unit

}  // namespace

struct LinearProgram::Work {
  ClpSimplex model;
  std::size_t columns = 0, rows = 0;
  std::size_t questions = 0;

  // 0 there is a point, 1 there is none.
  int solve() {
    ++questions;
    // Without presolve, which leaves no ray; from the last basis: only bounds have changed.
    model.dual();
    return model.status();
  }

  std::optional<double> extreme(std::size_t column, double direction) {
    model.setObjectiveCoefficient(static_cast<int>(column), direction);
    ++questions;
    // The last point is still one: only the objective is another.
    model.primal();
    const bool solved = model.status() == 0;
    const double value = solved ? model.primalColumnSolution()[column] : 0.0;
    model.setObjectiveCoefficient(static_cast<int>(column), 0.0);
    if (!solved) return std::nullopt;
    return value;
  }
};

LinearProgram::LinearProgram(std::size_t columns, const std::vector<ProgramRow>& rows)
    : work_(std::make_unique<Work>()) {
  Work& work = *work_;
  work.columns = columns;
  work.rows = rows.size();
  work.model.setLogLevel(0);
  work.model.scaling(0);  // rays of scaled programs are not to be relied upon
  work.model.setPrimalTolerance(kTolerance);
  work.model.resize(0, static_cast<int>(columns));
  for (std::size_t c = 0; c < columns; ++c) {
    work.model.setColumnBounds(static_cast<int>(c), 0.0, 0.0);
    work.model.setObjectiveCoefficient(static_cast<int>(c), 0.0);
  }
  std::vector<CoinBigIndex> starts{0};
  std::vector<int> at;
  std::vector<double> factors, highs;
  for (const ProgramRow& row : rows) {
    for (const auto& [column, factor] : row.terms) {
      at.push_back(static_cast<int>(column));
      factors.push_back(factor);
    }
    starts.push_back(static_cast<CoinBigIndex>(at.size()));
    highs.push_back(row.high);
  }
  const std::vector<double> lows(rows.size(), -COIN_DBL_MAX);
  if (!rows.empty())
    work.model.addRows(static_cast<int>(rows.size()), lows.data(), highs.data(), starts.data(), at.data(),
                       factors.data());
}

LinearProgram::LinearProgram(LinearProgram&&) noexcept = default;
LinearProgram& LinearProgram::operator=(LinearProgram&&) noexcept = default;
LinearProgram::~LinearProgram() = default;

void LinearProgram::bound(std::size_t column, double low, double high) {
  work_->model.setColumnBounds(static_cast<int>(column), low, high);
}

void LinearProgram::bound_row(std::size_t row, double low, double high) {
  work_->model.setRowBounds(static_cast<int>(row), low, high);
}

void LinearProgram::change_row(std::size_t row, const ProgramRow& to) {
  for (const auto& [column, factor] : to.terms)
    work_->model.modifyCoefficient(static_cast<int>(row), static_cast<int>(column), factor, true);
  work_->model.setRowUpper(static_cast<int>(row), to.high);
}

std::optional<std::vector<double>> LinearProgram::refute() {
  Work& work = *work_;
  if (work.solve() != 1) return std::nullopt;
  const std::unique_ptr<double[]> ray(work.model.infeasibilityRay());
  if (!ray) return std::nullopt;
  double largest = 0.0, sum = 0.0;
  for (std::size_t r = 0; r < work.rows; ++r) {
    largest = std::max(largest, std::abs(ray[r]));
    sum += ray[r];
  }
  if (!(largest > 0.0) || !std::isfinite(largest)) return std::nullopt;
  // Its sign is a matter of convention: of rows with an upper bound only, all multipliers have the same.
  std::vector<double> multipliers(work.rows, 0.0);
  const double sign = sum < 0.0 ? -1.0 : 1.0;
  for (std::size_t r = 0; r < work.rows; ++r) {
    const double multiplier = sign * ray[r] / largest;
    if (multiplier > 1e-12) multipliers[r] = multiplier;
  }
  return multipliers;
}

std::optional<double> LinearProgram::least(std::size_t column) {
  return work_->extreme(column, 1.0);
}

std::optional<double> LinearProgram::largest(std::size_t column) {
  return work_->extreme(column, -1.0);
}

std::span<const double> LinearProgram::point() const {
  return {work_->model.primalColumnSolution(), work_->columns};
}

std::size_t LinearProgram::questions() const {
  return work_->questions;
}

}  // namespace stepwright::tamp
