#pragma once

// A vehicle that does what VDA 5050 2.1.0 says of vehicles, message by message, without time: it takes or
// refuses orders as figure 8 of the standard has it, passes released nodes one by one, and says its state.
// It shares nothing with the master control but the messages.
//
//   StandardVehicle vehicle("Stepwright", "v1");
//   vehicle.take_order(to_json(order));
//   while (vehicle.drive()) tell(to_json(vehicle.state(now)));

#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::support {

class StandardVehicle {
 public:
  StandardVehicle(std::string manufacturer, std::string serial_number);

  // Takes a message: empty, or why it was refused.
  std::string take_order(const std::string& text);
  void take_instant_actions(const std::string& text);

  // Goes on to the next node of its base. False where there is none.
  bool drive();
  fleet::vda5050::State state(fleet::vda5050::Timestamp now);

  // Indices into the nodes of the order that it has.
  std::optional<std::size_t> passed() const { return passed_; }
  const std::optional<fleet::vda5050::Order>& order() const { return order_; }
  bool idle() const;

 private:
  std::string take_new(const fleet::vda5050::Order& order);
  std::string take_update(const fleet::vda5050::Order& update);
  std::size_t decision() const;

  std::string manufacturer_, serial_number_;
  fleet::vda5050::HeaderIds ids_;
  std::optional<fleet::vda5050::Order> order_;
  std::string order_id_;  // kept after a cancellation
  std::uint32_t update_id_ = 0;
  std::optional<std::size_t> passed_;
  std::string last_node_;
  std::uint32_t last_sequence_ = 0;
  std::optional<fleet::vda5050::AgvPosition> position_;
  std::vector<fleet::vda5050::ActionState> actions_;
  std::vector<fleet::vda5050::VehicleError> errors_;
};

}  // namespace stepwright::support
