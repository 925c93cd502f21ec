#pragma once

// Order to two arms: things in regions or on other things, as a goal in PDDL.
//
// Values and pure functions; any thread.
//
//   auto order = read_order(cell, "P1", "(in cup1 red-region)", "cell.toml");
//   const std::string problem = problem_text(cell, *order, state);   // for planner::read_skeletons

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::mission {

// A number of the cell as a place in its list.
inline std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

// A thing and where it is wanted: in a region, or on another thing.
struct Wanted {
  int thing = 0;
  int surface = -1;  // one of the two
  int on = -1;
  friend bool operator==(const Wanted&, const Wanted&) = default;
};

struct ArmsOrder {
  std::string name;
  std::string goal;  // PDDL: "(in cup1 red-region)", "(and (in can1 tray) (in can2 can1))"
  std::vector<Wanted> wanted;
};

// G0401: the text is no such goal, told at its place in `file`; P0002 and others of the notation itself.
[[nodiscard]] result::Result<ArmsOrder> read_order(const scene::RobotCell& cell, const std::string& name,
                                                   const std::string& goal, const std::string& file);

// G0402: a name of the cell that PDDL cannot say.
[[nodiscard]] result::Result<void> check_names(const scene::RobotCell& cell);

// "cup1 in red-region", "can2 on can1".
std::string text_of(const scene::RobotCell& cell, const Wanted& wanted);

// Whether it is so, as a camera sees it: by 5 mm at most otherwise.
bool is_met(const scene::RobotCell& cell, const scene::GeometricState& state, const Wanted& wanted);
// The first that is not; empty: all are met.
std::string not_yet(const scene::RobotCell& cell, const scene::GeometricState& state, const ArmsOrder& order);

// The problem in PDDL of the domain `stacking-arms`: arms at home and empty, things where they stand. With
// `exchange` only what is wanted is moved, by way of these regions alone (none: any); all else just stands
// there.
std::string problem_text(const scene::RobotCell& cell, const ArmsOrder& order,
                         const scene::GeometricState& state, const std::vector<int>* exchange);

}  // namespace stepwright::tamp::mission
