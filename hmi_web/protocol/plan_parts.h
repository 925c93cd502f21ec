#pragma once

// The supervisor's plan document as a viewer gets it: what of a fleet's plan is large and changes only with
// the plan (ways, polygons, critical sections) goes apart from what changes all the time (states, delays).
//
//   auto parts = plan_parts(document);
//   send(parts->routes);  // only if it differs from the one before; empty for a cell without a fleet
//   send(parts->plan);
//
// A pure function; any thread. It trusts nothing in the document.

#include <optional>
#include <string>

namespace stepwright::protocol {

struct PlanParts {
  std::string plan;    // message `plan`
  std::string routes;  // message `routes`; empty: the document has no fleet
};

// A way that is drawn without those of its poses that lie nearer than this to it is the same way to the eye.
inline constexpr double kWayTolerance_m = 0.02;

// nullopt if `document` is not a JSON object.
std::optional<PlanParts> plan_parts(const std::string& document);

}  // namespace stepwright::protocol
