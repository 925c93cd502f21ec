#pragma once

// How an arm that has met something goes back: along the way that it came, which was free a moment ago. What
// it has met is left out of the check of that way; the other arm, which may stand elsewhere by now, and
// things are not.
//
// A function without state; any thread. The same for a seed on every machine.
//
//   const motion::JointPath way = retreat({cell, cell_with_strangers, state}, 1, back);
//   if (way.empty()) ...   // it is clear where it is, or cannot go back

#include <cstddef>
#include <cstdint>

#include "supervisor/motion/path/path.h"
#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::mission {

struct RetreatScene {
  const scene::RobotCell& known;       // without what the arm has met
  const scene::RobotCell& there;       // with it, as large as it is taken to be
  const scene::GeometricState& state;  // where everything is
  std::uint64_t seed = 1;
};

// `back` begins where the arm is. The way goes as far back as the arm stays clear once it is, so that there
// is room for ways around; as far as it can go where no place is clear. At least two configurations, or none.
motion::JointPath retreat(const RetreatScene& scene, std::size_t arm, const motion::JointPath& back);

}  // namespace stepwright::tamp::mission
