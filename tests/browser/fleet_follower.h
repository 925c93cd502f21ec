#pragma once

// A plan of the fleet and what its program says now, as the plan document that viewers get: for tests of the
// page with processes that really run. It decides nothing.
//
//   FleetFollower follower(plan, program, container);
//   publisher.publish(follower.document(snapshot));

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/dds/types.h"
#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::browser {

class FleetFollower {
 public:
  // `plan` and `program` must outlive it; `digest` is that of the container.
  FleetFollower(const fleet::FleetPlan& plan, const fleet::FleetProgram& program,
                std::span<const std::byte> container, std::string digest);

  std::string document(const dds::Snapshot& snapshot);

 private:
  double value(const std::string& name, const dds::Snapshot& snapshot) const;
  nlohmann::json vehicle(std::size_t index, const dds::Snapshot& snapshot, double now_ms) const;
  // Who has to leave a polygon before this vehicle may go on.
  std::optional<std::size_t> waited_for(std::size_t index, const dds::Snapshot& snapshot) const;

  const fleet::FleetPlan& plan_;
  const fleet::FleetProgram& program_;
  reader::ProgramInfo info_;
  nlohmann::json document_;  // all that does not change
};

}  // namespace stepwright::browser
