#include "supervisor/pddl/search/lp/lp_program.h"

#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <algorithm>
#include <cmath>

#include "supervisor/pddl/ground_task/interval.h"

namespace stepwright::pddl {
namespace {

// Rounding errors of a reduced cost are weighed as if its column were as large as this.
constexpr double kLargeCount = 1e4;
// Below this a multiplier is rounding.
constexpr double kNoMultiplier = 1e-11;
// A proof of infeasibility must be clear by this much.
constexpr double kClear = 1e-5;

class StopHandler final : public ClpEventHandler {
 public:
  const std::function<bool()>* stop = nullptr;

  int event(Event which) override { return which == endOfIteration && stop != nullptr && (*stop)() ? 1 : -1; }
  ClpEventHandler* clone() const override { return new StopHandler(*this); }
};

// Entries row by row.
struct RowEntries {
  std::vector<CoinBigIndex> starts{0};
  std::vector<int> columns;
  std::vector<double> coefficients, lows;

  void add(const LpRow& row) {
    for (const LpEntry& entry : row.entries) {
      columns.push_back(entry.column);
      coefficients.push_back(entry.coefficient);
    }
    starts.push_back(static_cast<CoinBigIndex>(columns.size()));
    lows.push_back(row.low);
  }
  void keep(std::size_t rows) {
    starts.resize(rows + 1);
    columns.resize(static_cast<std::size_t>(starts.back()));
    coefficients.resize(columns.size());
    lows.resize(rows);
  }
  std::size_t size() const { return lows.size(); }
};

}  // namespace

struct LpProgram::Work {
  std::vector<double> costs, reduced;
  RowEntries matrix;
  std::size_t first_rows = 0;
  ClpSimplex model;
  std::vector<unsigned char> basis;  // before rows were added
  std::vector<double> multipliers;

  void load() {
    model.setLogLevel(0);
    model.scaling(0);
    model.resize(0, static_cast<int>(costs.size()));
    for (std::size_t c = 0; c < costs.size(); ++c) {
      const int column = static_cast<int>(c);
      model.setColumnBounds(column, 0.0, COIN_DBL_MAX);
      model.setObjectiveCoefficient(column, costs[c]);
    }
    give(0);
    first_rows = matrix.size();
  }

  // A row without entries is judged here: the solver does not hear of it.
  bool empty(std::size_t row) const { return matrix.starts[row] == matrix.starts[row + 1]; }
  double low_for_solver(std::size_t row) const {
    return empty(row) ? -COIN_DBL_MAX : std::max(matrix.lows[row], -COIN_DBL_MAX);
  }
  bool impossible() const {
    for (std::size_t r = 0; r < matrix.size(); ++r) {
      if (matrix.lows[r] > kClear && empty(r)) return true;
    }
    return false;
  }

  // Hands the rows from `first` on to the solver.
  void give(std::size_t first) {
    const std::size_t count = matrix.size() - first;
    if (count == 0) return;
    std::vector<CoinBigIndex> starts(matrix.starts.begin() + static_cast<std::ptrdiff_t>(first),
                                     matrix.starts.end());
    const CoinBigIndex base = starts.front();
    for (CoinBigIndex& start : starts) start -= base;
    std::vector<double> lows;
    for (std::size_t r = first; r < matrix.size(); ++r) lows.push_back(low_for_solver(r));
    const std::vector<double> highs(count, COIN_DBL_MAX);
    model.addRows(static_cast<int>(count), lows.data(), highs.data(), starts.data(),
                  matrix.columns.data() + base, matrix.coefficients.data() + base);
  }

  // What the multipliers prove: sum of multiplier x low, if no column is paid more for than `prices` say.
  // Fills `reduced` with what is left of the prices.
  double certified(std::span<const double> prices) {
    double sum = 0.0;
    reduced.assign(prices.begin(), prices.end());
    for (std::size_t r = 0; r < matrix.size(); ++r) {
      const double multiplier = multipliers[r];
      if (!(multiplier > kNoMultiplier) || matrix.lows[r] == -kInfinity) continue;
      sum += multiplier * matrix.lows[r];
      for (auto i = static_cast<std::size_t>(matrix.starts[r]);
           i < static_cast<std::size_t>(matrix.starts[r + 1]); ++i) {
        reduced[static_cast<std::size_t>(matrix.columns[i])] -= multiplier * matrix.coefficients[i];
      }
    }
    for (double& rest : reduced) {
      if (rest >= 0.0) continue;
      sum += kLargeCount * rest;
      rest = 0.0;
    }
    return sum;
  }

  double cost_bound() {
    const double* prices = model.getRowPrice();
    multipliers.assign(prices, prices + matrix.size());
    const double sum = certified(costs);
    if (sum > 0.0) return sum;
    reduced = costs;  // no multiplier at all proves as much
    return 0.0;
  }

  // Does the solver's ray prove that no x meets all rows? Its sign is a matter of convention.
  bool infeasible() {
    const std::unique_ptr<double[]> ray(model.infeasibilityRay());
    if (!ray) return false;
    const std::vector<double> nothing(costs.size(), 0.0);
    double largest = 0.0;
    for (std::size_t r = 0; r < matrix.size(); ++r) largest = std::max(largest, std::abs(ray[r]));
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;
    for (const double sign : {1.0, -1.0}) {
      multipliers.assign(matrix.size(), 0.0);
      for (std::size_t r = 0; r < matrix.size(); ++r) multipliers[r] = sign * ray[r] / largest;
      if (certified(nothing) > kClear) return true;
    }
    return false;
  }
};

LpProgram::LpProgram(std::vector<double> costs, const std::vector<LpRow>& rows)
    : work_(std::make_unique<Work>()) {
  work_->costs = std::move(costs);
  for (const LpRow& row : rows) work_->matrix.add(row);
  work_->load();
}

LpProgram::LpProgram(LpProgram&&) noexcept = default;
LpProgram& LpProgram::operator=(LpProgram&&) noexcept = default;
LpProgram::~LpProgram() = default;

std::size_t LpProgram::rows() const {
  return work_->matrix.size();
}

void LpProgram::set_low(std::size_t row, double low) {
  work_->matrix.lows[row] = low;
  work_->model.setRowLower(static_cast<int>(row), work_->low_for_solver(row));
}

void LpProgram::add_rows(std::span<const LpRow> rows) {
  Work& work = *work_;
  const std::size_t before = work.matrix.size();
  if (before == work.first_rows) {
    const unsigned char* status = work.model.statusArray();
    work.basis.assign(status, status + (status == nullptr ? 0 : work.costs.size() + before));
  }
  for (const LpRow& row : rows) work.matrix.add(row);
  work.give(before);
}

void LpProgram::drop_rows() {
  Work& work = *work_;
  std::vector<int> which;
  for (std::size_t r = work.first_rows; r < work.matrix.size(); ++r) which.push_back(static_cast<int>(r));
  if (which.empty()) return;
  work.model.deleteRows(static_cast<int>(which.size()), which.data());
  work.matrix.keep(work.first_rows);
  if (!work.basis.empty()) work.model.copyinStatus(work.basis.data());
}

LpSolution LpProgram::minimize(const std::function<bool()>& stop, int most_iterations) {
  Work& work = *work_;
  if (work.impossible()) return {kInfinity, true, 0};
  if (work.costs.empty() || work.matrix.size() == 0) {
    work.reduced = work.costs;
    return {0.0, true, 0};
  }
  StopHandler handler;
  handler.stop = &stop;
  work.model.passInEventHandler(&handler);
  work.model.setMaximumIterations(most_iterations);
  work.model.dual();
  LpSolution solution;
  solution.iterations = work.model.numberIterations();
  solution.finished = work.model.status() == 0 || work.model.status() == 1;
  solution.bound = work.model.status() == 1 && work.infeasible() ? kInfinity : work.cost_bound();
  return solution;
}

std::span<const double> LpProgram::reduced_costs() const {
  return work_->reduced;
}

std::span<const double> LpProgram::values() const {
  return {work_->model.primalColumnSolution(), work_->costs.size()};
}

}  // namespace stepwright::pddl
