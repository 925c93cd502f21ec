#pragma once

// The object "fleet" of the supervisor's plan document as the plan that the fleet keeps to, and what the
// supervisor knows of each vehicle beside it (supervisor/doc/vda5050.md says which keys are read).
//
// Pure; any thread. F0911: the document is no JSON, lacks a key or contradicts itself, with the JSON pointer
// of what is wrong. A document without "fleet" is none of a fleet: no plan, no fault.
//
//   auto document = read_fleet_document(text, "plan document", models);
//   if (document && document->fleet) orders.adopt(document->fleet->plan, now, places);

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::vda5050_link {

struct DocumentVehicle {
  std::string name;
  std::string variable;       // stands in the names of the program's variables
  std::string serial_number;  // the name or, where that cannot be a level of a topic, the variable
  std::string state;          // "driving", "lost" ...; empty: not told
  std::string reason;         // of "lost" and "stopped"
  std::optional<std::size_t> stops_done;
};

struct FleetDocument {
  std::uint64_t revision = 0;
  fleet::FleetPlan plan;  // missions are called by serial numbers; in the order of `vehicles`
  std::vector<DocumentVehicle> vehicles;
};

struct PlanDocument {
  std::string program_digest;  // of the program that keeps to it; empty: not told
  std::string phase;
  std::optional<FleetDocument> fleet;
};

// Outline and speed of the vehicle with this variable.
struct VehicleData {
  fleet::VehicleModel model;
  double max_mps = 1.5;
};
using DataOf = std::function<VehicleData(const std::string& variable)>;

[[nodiscard]] result::Result<PlanDocument> read_plan_document(const std::string& text,
                                                              const std::string& source, const DataOf& data);

}  // namespace stepwright::vda5050_link
