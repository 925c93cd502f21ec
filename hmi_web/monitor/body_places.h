#pragma once

// Places of a body in ST at which something is computed: the conditions that it tests, and the variables
// whose index is not fixed.
//
//   BodyPlaces places = places_of(body);
//
// Pure; views the body.

#include <vector>

#include "hmi_web/monitor/sheet.h"

namespace stepwright::monitor {

struct BodyPlaces {
  // Of IF, ELSIF, WHILE and UNTIL, where they begin; of a transition the whole.
  std::vector<std::pair<source::Position, const syntax::Expression*>> conditions;
  // "a[i].x", where "a" stands.
  std::vector<std::pair<source::Position, const syntax::Expression*>> indexed;
};

BodyPlaces places_of(const Body& body);

}  // namespace stepwright::monitor
