#pragma once

// A fault of a simulated plant, as the runtime tells of it. Plain values; any thread.

#include <string>

namespace stepwright::host {

struct PlantFault {
  std::string name;
  std::string unit;
  std::string meaning;
  double low = 0.0;  // what happens to plants of the kind; the same as `high`: nothing is known
  double high = 0.0;
  bool whole = false;  // whole numbers only
  bool holds = false;
  double value = 0.0;  // while it holds, in its unit

  friend bool operator==(const PlantFault&, const PlantFault&) = default;
};

}  // namespace stepwright::host
