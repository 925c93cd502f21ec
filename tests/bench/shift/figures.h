#pragma once

// Figures of a run of a shift. Values.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::bench::shift {

struct Delivery {
  std::optional<double> assigned_s;
  std::optional<double> picked_s;
  std::optional<double> delivered_s;
  std::optional<std::uint32_t> vehicle;
};

// How a vehicle spent the shift, in seconds.
struct Spent {
  double busy_s = 0.0;  // with a job; the others are parts of all of its time
  double driving_s = 0.0;
  double serving_s = 0.0;
  double waiting_s = 0.0;  // for other vehicles
  double held_s = 0.0;     // before blocked places
  double paused_s = 0.0;
  double dead_s = 0.0;
  double resting_s = 0.0;
};

// CPU milliseconds of decisions of one kind.
struct Times {
  std::vector<double> ms;
  double quantile(double q) const;
  double sum() const;
};

struct Decisions {
  std::map<std::string, Times> times;  // by cause
  std::map<std::string, std::uint32_t> refused;
  std::uint64_t orders_kept = 0;
};

struct ShiftFigures {
  std::vector<Delivery> deliveries;  // by transport
  std::vector<Spent> spent;          // by vehicle
  Decisions decisions;
  Times retimes;
  std::uint64_t delays = 0;
  std::uint32_t rerouted = 0, sent_home = 0, waited = 0;  // vehicles by blocked places and dead ones
  double longest_wait_s = 0.0;                            // for other vehicles, at one place
  double simulated_s = 0.0;
  double cpu_s = 0.0;
  double plant_cpu_s = 0.0;
  double control_cpu_s = 0.0;
  double judge_cpu_s = 0.0;
};

// Of the thread, and of all threads together.
double cpu_s();
double process_cpu_s();

}  // namespace stepwright::bench::shift
