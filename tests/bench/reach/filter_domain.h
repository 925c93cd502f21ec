#pragma once

// Algorithm 1 of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012 (FilterDomain) as printed: one interval for
// each of four variables of every pose of an object and of a tool; grasp and transfer as equations; the map
// of an arm as two hyperplanes (linear regression, shifted to the farthest residual) over the tool's box; and
// for each variable two linear programs, again and again until nothing changes by more than epsilon.
//
// Tuned: one program (COIN-OR Clp) is kept, only bounds and the hyperplanes' rows change, each question
// starts from the last basis; the first round has no hyperplanes, so that no regression is made over all of
// the map. An object's angle is not reduced to one turn: final angles are asked for on each turn that can be
// meant. Grasps from above only.
//
// Thread rule: one owner.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/network/linear_program.h"
#include "supervisor/tamp/intervals/search/instances.h"
#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::bench {

struct Interval {
  double low = 0.0, high = 0.0;
};
using Domain = std::vector<Interval>;

class FilterDomain {
 public:
  // `turns`: a whole number that is added to the last action's final angle.
  FilterDomain(const tamp::WorkCell& cell, std::span<const tamp::Action> sequence, int turns,
               double epsilon = 1e-4);

  const Domain& initial() const { return initial_; }
  // Nothing: inconsistent.
  std::optional<Domain> filter(const Domain& domain);
  // A configuration within the domain, as a narrower domain; nothing if it is not in it. 1e-6 of a tolerance.
  std::optional<Domain> assign(const Domain& domain, const tamp::Configuration& to) const;

  std::size_t programs() const { return program_->questions(); }  // that were solved

 private:
  struct Handled {
    std::size_t object_column = 0, tool_column = 0;  // x; y, z and the angle follow
    std::size_t map_row = 0;                         // two rows
    const tamp::ReachBounds* reach = nullptr;
  };
  struct Plane {
    double x = 0.0, y = 0.0, z = 0.0, at = 0.0;
  };
  struct Planes {
    Plane low, high;
  };

  std::size_t add_pose(Interval x, Interval y, Interval z, Interval angle);
  void add_equation(std::vector<std::pair<std::size_t, double>> terms, double value);
  bool update_maps(const Domain& domain);
  static std::optional<Planes> planes_of(const tamp::ReachBounds& reach, const Domain& domain,
                                         std::size_t column);
  void load(const Domain& domain);

  double epsilon_;
  Domain initial_;
  std::vector<tamp::ProgramRow> rows_;
  std::vector<std::pair<std::size_t, double>> equations_;  // row, value
  std::vector<std::optional<Handled>> handled_;            // of each action
  std::unique_ptr<tamp::LinearProgram> program_;
};

}  // namespace stepwright::bench
