#pragma once

// Disturbance of one run of a campaign: faults that the cell's plant offers, one or several at once, at
// random times, for good or for a while. A pure function of the seed, the faults offered and the horizon.
//
//   auto offered = offered_faults(*plant);
//   Disturbance what = draw(7, offered, 120.0);   // within the first 120 s of plant time
//   what.words()                                  // "leak_a1 = 0.42 percent/s from 31.7 s for 12.0 s"
//
// Thread-safe: pure.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/simulation/simulated_controller.h"
#include "plant_models/core/plant.h"
#include "runtime/ground/result/result.h"

namespace stepwright::campaign {

struct OfferedFault {
  std::string name;
  std::string unit;
  core::FaultRange range;
};

// Those of which the plant knows what happens.
std::vector<OfferedFault> offered_faults(const core::Plant& plant);

// Those that one of the patterns fits, upper and lower case alike; '*' stands for any text. No pattern: all.
// Fails with C0311 for a pattern that fits none.
[[nodiscard]] result::Result<std::vector<OfferedFault>> chosen(const std::vector<OfferedFault>& offered,
                                                               const std::vector<std::string>& patterns);
bool fits(std::string_view pattern, std::string_view name);

struct DrawnFault {
  std::string name;
  std::string unit;
  double value = 0.0;
  double at_s = 0.0;
  std::optional<double> ends_s = std::nullopt;  // nothing: it stays
};

struct Disturbance {
  std::vector<DrawnFault> faults;  // by time; none: an undisturbed run

  // "none", "single" or "compound".
  const char* kind() const;
  std::string words() const;
  std::vector<simulation::PlantFault> schedule() const;
};

// One run of eight has no fault, of the others every second one several, three at most.
Disturbance draw(std::uint64_t seed, const std::vector<OfferedFault>& offered, double horizon_s);

}  // namespace stepwright::campaign
