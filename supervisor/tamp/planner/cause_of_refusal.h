#pragma once

// Why a sequence that intervals refuted cannot be done, in words. What would do is only said of a cell, with
// one number changed, for which there is a plan.
//
// A function without state; any thread.

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "supervisor/tamp/planner/tamp_planner.h"

namespace stepwright::tamp::planner {

// Whether there is a plan for a cell that is like the planner's own one but for where something stands.
using Solvable = std::function<bool(const scene::RobotCell&, const IntervalModel&, const TampOptions&)>;

std::optional<std::string> cause_of_refusal(const scene::RobotCell& cell, const IntervalModel& model,
                                            std::span<const Action> refuted, const TampOptions& options,
                                            const Solvable& solvable);

}  // namespace stepwright::tamp::planner
