#pragma once

// Messages of a vehicle: state, visualization and connection as values (VDA 5050 2.1.0, sections 6.10, 6.13,
// 6.14). Information and maps of a state are not kept. Values; any thread may read.
//
//   const auto state = read_state(payload, topic);   // read_message.h
//   if (state && state->last_node_sequence >= 4) ...

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/order.h"

namespace stepwright::fleet::vda5050 {

enum class OperatingMode : std::uint8_t { Automatic, SemiAutomatic, Manual, Service, TeachIn };
enum class ActionStatus : std::uint8_t { Waiting, Initializing, Running, Paused, Finished, Failed };
enum class ErrorLevel : std::uint8_t { Warning, Fatal };
enum class EmergencyStop : std::uint8_t { AutoAck, Manual, Remote, None };
enum class ConnectionState : std::uint8_t { Online, Offline, Broken };

struct NodeState {
  std::string id;
  std::uint32_t sequence = 0;
  bool released = false;

  friend bool operator==(const NodeState&, const NodeState&) = default;
};

struct EdgeState {
  std::string id;
  std::uint32_t sequence = 0;
  bool released = false;

  friend bool operator==(const EdgeState&, const EdgeState&) = default;
};

struct AgvPosition {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
  std::string map_id;
  bool initialized = true;

  friend bool operator==(const AgvPosition&, const AgvPosition&) = default;
};

// In the frame of the vehicle.
struct Velocity {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double omega_radps = 0.0;

  friend bool operator==(const Velocity&, const Velocity&) = default;
};

struct ActionState {
  std::string id;
  std::string type;  // may be empty
  ActionStatus status = ActionStatus::Waiting;
  std::string result;  // may be empty

  friend bool operator==(const ActionState&, const ActionState&) = default;
};

struct Battery {
  double charge_percent = 100.0;
  bool charging = false;

  friend bool operator==(const Battery&, const Battery&) = default;
};

struct VehicleError {
  std::string type;
  ErrorLevel level = ErrorLevel::Warning;
  std::string description;  // may be empty
  std::vector<std::pair<std::string, std::string>> references;

  friend bool operator==(const VehicleError&, const VehicleError&) = default;
};

struct State {
  Header header;
  std::string order_id;         // empty: none yet
  std::uint32_t update_id = 0;  // of the last update that the vehicle took
  std::string last_node;        // empty: none yet
  std::uint32_t last_node_sequence = 0;
  bool driving = false;
  bool paused = false;
  bool new_base_request = false;
  OperatingMode mode = OperatingMode::Automatic;
  std::vector<NodeState> nodes;  // still to be traversed
  std::vector<EdgeState> edges;
  std::optional<AgvPosition> position;
  std::optional<Velocity> velocity;
  std::optional<std::size_t> loads;  // how many; nothing: it cannot tell
  std::vector<ActionState> actions;
  Battery battery;
  std::vector<VehicleError> errors;
  EmergencyStop emergency_stop = EmergencyStop::None;
  bool field_violation = false;

  friend bool operator==(const State&, const State&) = default;
};

struct Visualization {
  Header header;
  std::optional<AgvPosition> position;
  std::optional<Velocity> velocity;
};

struct Connection {
  Header header;
  ConnectionState state = ConnectionState::Online;

  friend bool operator==(const Connection&, const Connection&) = default;
};

}  // namespace stepwright::fleet::vda5050
