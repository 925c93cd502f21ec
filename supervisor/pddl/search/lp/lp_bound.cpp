#include "supervisor/pddl/search/lp/lp_bound.h"

#include <algorithm>

#include "supervisor/pddl/search/bounds/cost_unit.h"

namespace stepwright::pddl {
namespace {

// A round that raises the bound by less, in relation, is the last.
constexpr double kLittle = 1e-3;

}  // namespace

LpBound::LpBound(const RelaxedTask& task, std::function<bool()> stop)
    : stop_(std::move(stop)),
      rows_(task, stop_),
      cut_(task, stop_),
      columns_(cut_.costs().size()),
      cost_unit_(common_unit(cut_.costs())) {
  cost_program_.emplace(std::vector<double>(cut_.costs().begin(), cut_.costs().end()), rows_.rows());
}

std::size_t LpBound::memory() const {
  std::size_t entries = 0;
  for (const LpRow& row : rows_.rows()) entries += row.entries.size();
  const std::size_t programs = steps_program_ ? 3 : 2;
  return programs * (4 * sizeof(LpEntry) * entries + 100 * (columns_ + rows_.rows().size()));
}

void LpBound::lower_rows(LpProgram& program, const Word* state) const {
  for (std::size_t r = 0; r < rows_.rows().size(); ++r) program.set_low(r, rows_.low(r, state));
}

// The program's bound and that of sets under what the program leaves of the costs add up; then the sets
// become rows, and the program is solved again.
double LpBound::minimize(LpProgram& program, const Word* state, const LpEffort& effort, double unit,
                         Proved& proved) {
  LpSolution solution = program.minimize(stop_, effort.iterations);
  iterations_ += static_cast<std::uint64_t>(solution.iterations);
  double best = rounded_up(solution.bound, unit);
  const auto prove = [&](double total, auto&& rest) {
    if (total < proved.total) return;
    proved.total = total;
    for (std::size_t op = 0; op < columns_; ++op) proved.rest[op] = rest(op);
  };
  const auto reduced = [&](std::size_t op) { return program.reduced_costs()[op]; };
  proved.total = 0.0;
  proved.rest.assign(columns_, 0.0);
  if (solution.bound < kInfinity) prove(solution.bound, reduced);
  for (int round = 0; round < effort.rounds && best < effort.enough; ++round) {
    if (!solution.finished || stop_()) break;
    found_.clear();
    const double more = cut_(state, program.reduced_costs(), [this](const OperatorLandmark& set) {
      LpRow& row = found_.emplace_back();
      row.low = 1.0;
      for (std::size_t i = 0; i < set.operators.size(); ++i) {
        row.entries.push_back({set.operators[i], set.weights[i]});
      }
    });
    sets_ += found_.size();
    best = std::max(best, rounded_up(solution.bound + more, unit));
    if (more < kInfinity) {
      prove(solution.bound + more, [&](std::size_t op) { return cut_.rest(static_cast<int>(op)); });
    }
    if (more == kInfinity || found_.empty() || round + 1 == effort.rounds || best >= effort.enough) break;
    program.add_rows(found_);
    const double before = solution.bound;
    solution = program.minimize(stop_, effort.iterations);
    iterations_ += static_cast<std::uint64_t>(solution.iterations);
    best = std::max(best, rounded_up(solution.bound, unit));
    if (solution.bound < kInfinity) prove(solution.bound, reduced);
    if (solution.bound == kInfinity || solution.bound < before + kLittle * std::max(1.0, before)) break;
  }
  program.drop_rows();
  return best;
}

double LpBound::cost(const Word* state, const LpEffort& effort) {
  lower_rows(*cost_program_, state);
  return minimize(*cost_program_, state, effort, cost_unit_, cost_);
}

double LpBound::cost_through(int op) const {
  return rounded_up(cost_.total + cost_.rest[static_cast<std::size_t>(op)], cost_unit_);
}

// One more row: the plan's cost is at most what is allowed.
LpProgram& LpBound::steps_program() {
  if (steps_program_) return *steps_program_;
  std::vector<LpRow> rows = rows_.rows();
  LpRow& allowed = rows.emplace_back();
  for (std::size_t c = 0; c < columns_; ++c) {
    if (cut_.costs()[c] > 0.0) allowed.entries.push_back({static_cast<int>(c), -cut_.costs()[c]});
  }
  return steps_program_.emplace(std::vector<double>(columns_, 1.0), rows);
}

double LpBound::steps(const Word* state, double most_cost, const LpEffort& effort) {
  LpProgram& program = steps_program();
  lower_rows(program, state);
  program.set_low(rows_.rows().size(), -most_cost - 1e-6 * std::max(1.0, most_cost));
  return minimize(program, state, effort, 1.0, steps_);
}

}  // namespace stepwright::pddl
