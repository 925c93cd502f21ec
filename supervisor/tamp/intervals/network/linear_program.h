#pragma once

// Linear rows over bounded variables (dual simplex of COIN-OR Clp, behind this header): is there a point?
// Rows stay, bounds change, and each question starts from the last basis. What it says is a guess:
// multipliers are checked by whoever draws conclusions.
//
// Thread rule: one owner.
//
//   LinearProgram program(2, {{{{0, 1.0}, {1, 1.0}}, 3.0}});
//   program.bound(0, 2.0, 5.0);
//   program.bound(1, 2.0, 5.0);
//   program.refute();                 // {1.0}: 2 + 2 > 3

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stepwright::tamp {

struct ProgramRow {
  std::vector<std::pair<std::size_t, double>> terms;  // each column once at most
  double high = 0.0;
};

class LinearProgram {
 public:
  LinearProgram(std::size_t columns, const std::vector<ProgramRow>& rows);
  LinearProgram(LinearProgram&&) noexcept;
  LinearProgram& operator=(LinearProgram&&) noexcept;
  ~LinearProgram();

  void bound(std::size_t column, double low, double high);
  // Of a row that is an equation: low == high.
  void bound_row(std::size_t row, double low, double high);
  void change_row(std::size_t row, const ProgramRow& to);
  // Multipliers of the rows, none below 0, whose sum no point within the bounds meets; nothing if there seems
  // to be a point.
  std::optional<std::vector<double>> refute();
  // The least or largest value of a column; nothing if there is no point.
  std::optional<double> least(std::size_t column);
  std::optional<double> largest(std::size_t column);
  // The point of the last question that had one.
  std::span<const double> point() const;
  std::size_t questions() const;  // how many were asked

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace stepwright::tamp
