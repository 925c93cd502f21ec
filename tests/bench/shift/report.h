#pragma once

// Figures of runs as text, JSON and pictures, and the oracle that says which deadlines can be kept. Pure
// functions but for the planner's memory of ways.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/shift/what_if.h"

namespace stepwright::bench::shift {

// By transport: whether it could be delivered in time if it were alone: on an empty floor, from its release
// on, by the best of the four vehicles whose homes are nearest to where it is, each starting at home, with
// the times that standing really takes.
std::vector<bool> can_be_kept(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles);

struct Summary {
  std::size_t released = 0;
  std::size_t delivered = 0;
  std::size_t late = 0;           // delivered after their deadline, or not at all although it has passed
  double mean_tardiness_s = 0.0;  // of those delivered
  double mean_delivery_s = 0.0;   // from release
  double utilisation = 0.0;       // share of time that vehicles have a job
};
Summary summary_of(const Scenario& scenario, const ShiftFigures& figures);

std::string text_of(const Scenario& scenario, const PlantRun& run, const std::vector<bool>& kept_by_oracle);
nlohmann::json json_of(const Scenario& scenario, const PlantRun& run,
                       const std::vector<bool>& kept_by_oracle);

// The hall with the ways that vehicles took and the places that were blocked.
std::string picture_of(const Scenario& scenario, const PlantRun& run);

struct SweepRow {
  std::uint32_t vehicles = 0;
  Summary summary;
  double cpu_s = 0.0;
};
// The smallest number with which no more are late than one in two hundred, or than with the best number.
std::uint32_t enough_vehicles(std::span<const SweepRow> rows);
// Deliveries an hour, lateness and utilisation over the number of vehicles, and how many suffice.
std::string plot_of(std::span<const SweepRow> rows, double hours);

}  // namespace stepwright::bench::shift
