#pragma once

// Why a sequence of actions has no solution: the steps by which intervals shrank, each with the constraints
// that it follows from, up to an empty one, or to a sum of linear conditions that no point within the
// intervals meets (Farkas). Whoever does not trust the propagation follows the steps again: each is a
// question about one constraint only. Plain values.

#include <cstdint>
#include <vector>

#include "supervisor/tamp/intervals/network/constraint.h"

namespace stepwright::tamp {

enum class StepKind : std::uint8_t {
  Given,   // `subject`: a constraint, which says so by itself
  Spot,    // `subject`: a spot; no angle or position outside is reached by all the hands that come there
  Row,     // `subject`: a linear row
  Chosen,  // by whoever searches: what follows is refuted for this choice only
};

// The variable lies within `span` or `arcs` because of the subject and of what is known before this step.
struct Step {
  StepKind kind = StepKind::Given;
  std::uint32_t subject = 0;
  bool is_angle = false;
  std::uint32_t variable = 0;
  Span span{};
  ArcSet arcs{};

  bool is_conflict() const { return is_angle ? arcs.empty() : span.empty(); }
};

struct Certificate {
  std::vector<Step> steps;  // in their order; the last one is the conflict, if there are no multipliers
  std::vector<double> multipliers;  // of the rows, none below 0
};

}  // namespace stepwright::tamp
