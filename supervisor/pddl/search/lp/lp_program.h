#pragma once

// A linear program: the least `cost` x under `row` x >= low for every row and x >= 0. It is built once; then
// bounds of rows change, rows come and go at its end, and each solution starts from the last basis (dual
// simplex of COIN-OR Clp, behind this header).
//
// Invariant: a bound is never too high. It is proved by multipliers of the rows, checked against the program
// itself; so an inexact solution, or one that was stopped early, still gives a lower bound.
//
// Thread rule: one owner.
//
//   LpProgram program({1.0, 2.0}, {{{{0, 1.0}, {1, 3.0}}, 5.0}});
//   program.minimize(stop).bound;   // 10 / 3

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace stepwright::pddl {

struct LpEntry {
  int column = 0;
  double coefficient = 0.0;
};

struct LpRow {
  std::vector<LpEntry> entries;  // every column once at most
  double low = 0.0;              // -kInfinity: no condition
};

struct LpSolution {
  double bound = 0.0;     // no feasible x costs less; kInfinity: there is none
  bool finished = false;  // else it was stopped, or the solver gave up
  int iterations = 0;     // of the simplex method
};

class LpProgram {
 public:
  // Costs must not be negative.
  LpProgram(std::vector<double> costs, const std::vector<LpRow>& rows);
  LpProgram(LpProgram&&) noexcept;
  LpProgram& operator=(LpProgram&&) noexcept;
  ~LpProgram();

  std::size_t rows() const;
  void set_low(std::size_t row, double low);

  // Rows behind the first ones. `drop_rows` takes them all away and goes back to the basis of before.
  void add_rows(std::span<const LpRow> rows);
  void drop_rows();

  // Asks `stop` after every iteration; gives up after `most_iterations`.
  LpSolution minimize(const std::function<bool()>& stop, int most_iterations);

  // Reduced cost of every column under the last solution's multipliers: not negative. Bounds under these
  // costs may be added to the solution's bound.
  std::span<const double> reduced_costs() const;

  // The last x: a guess, nothing is proved of it.
  std::span<const double> values() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace stepwright::pddl
