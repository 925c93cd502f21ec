#pragma once

// The vehicle's side of VDA 5050 for a vehicle whose controller keeps to a plan on its own: it takes the
// orders of the plan's master control, says how far they are done, and answers what anybody else asks for.
//
// Requests that the controller cannot carry out are refused with an action state FAILED and an error, never
// ignored: orders of others, pauses, cancellations by others, unknown actions, messages that break the rules.
// Refusals stay in the state for `kRefusalStays` and are bounded in number, whatever comes.
//
// One thread at a time; time is passed in.
//
//   VehicleSide side({"uagv", "Stepwright", "v1"});
//   side.take(order, Sender::Control, now);
//   side.show({.position = ..., .order_id = order.order_id, .passed = 3});
//   if (side.has_news()) publish(to_json(side.state(now)));

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/header.h"
#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

// State of the vehicle as the controller shows it.
struct VehicleReading {
  std::optional<AgvPosition> position{};  // nothing: not known yet
  Velocity velocity{};
  bool driving = false;
  std::string order_id{};      // that the next three are of; another order stays as far as it was
  std::size_t passed = 0;      // nodes that lie behind the vehicle, by the way
  std::size_t unfinished = 0;  // of the actions at the last of these that has some, from the back
  bool action_failed = false;  // the first of the unfinished ones has
  std::optional<std::size_t> loads{};
  std::vector<VehicleError> errors{};
  EmergencyStop emergency_stop = EmergencyStop::None;
  bool field_violation = false;

  friend bool operator==(const VehicleReading&, const VehicleReading&) = default;
};

enum class Sender : std::uint8_t {
  Control,   // the master control of the plan that the controller keeps to
  Stranger,  // anybody else at the broker
};

// Messages that instant actions ask for.
struct RequestedMessages {
  bool state = false;
  bool factsheet = false;
};

class VehicleSide {
 public:
  static constexpr std::chrono::seconds kRefusalStays{60};
  static constexpr std::size_t kMostRefusals = 8;
  static constexpr std::size_t kMostInstantActions = 32;

  explicit VehicleSide(Address address) : address_(std::move(address)) {}

  void take(const Order& order, Sender sender, Timestamp now);
  // `cancel_id`: the cancelOrder of the plan's master control; the only one that is obeyed.
  RequestedMessages take(const InstantActions& message, const std::string& cancel_id, Timestamp now);
  // A message that is none.
  void refuse(Topic topic, const result::Diagnostics& wrong, Timestamp now);
  void show(VehicleReading reading);

  // Something other than the place has changed since the last state.
  bool has_news(Timestamp now);
  State state(Timestamp now);
  Visualization visualization(Timestamp now);
  Connection connection(ConnectionState connection, Timestamp now);
  // Of the next factsheet.
  Header factsheet_header(Timestamp now);
  const Address& address() const { return address_; }
  const std::optional<Order>& order() const { return order_; }

 private:
  struct Refusal {
    VehicleError error;
    Timestamp since;
  };

  void refuse(VehicleError error, Timestamp now);
  void refuse_action(const Action& action, const Header& header, const std::string& why, Timestamp now);
  void answer(const Action& action, ActionStatus status, const std::string& result);
  void forget_refusals(Timestamp now);
  // Nodes behind the vehicle, of those that are released.
  std::size_t passed() const;
  std::vector<ActionState> order_actions() const;
  State contents() const;

  Address address_;
  HeaderIds ids_;
  std::optional<Order> order_;
  std::string order_id_;  // of the last order; kept when it is cancelled
  std::uint32_t update_id_ = 0;
  std::string last_node_;
  std::uint32_t last_sequence_ = 0;
  std::deque<ActionState> instants_;
  std::deque<Refusal> refusals_;
  VehicleReading reading_;
  // Of the order that the vehicle has.
  struct Progress {
    std::size_t passed = 0;
    std::size_t unfinished = 0;
    bool action_failed = false;
  };
  Progress progress_;
  std::optional<State> said_;  // without header, place and speed
};

}  // namespace stepwright::fleet::vda5050
