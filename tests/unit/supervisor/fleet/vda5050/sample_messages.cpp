#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

#include <chrono>

#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::fleet::vda5050 {

namespace {

Header header() {
  using namespace std::chrono;
  return {.header_id = 7,
          .timestamp = sys_days(year(2026) / 11 / 23) + 3h + 50min + 125ms,
          .version = "2.1.0",
          .manufacturer = "Stepwright",
          .serial_number = "v1"};
}

Node node(std::size_t index, bool released) {
  const std::string sequence = std::to_string(2 * index);
  return {.id = "o1.n" + sequence,
          .sequence = static_cast<std::uint32_t>(2 * index),
          .description = index == 1 ? "rack" : "",
          .released = released,
          .position = NodePosition{.x_m = 1.5 * static_cast<double>(index),
                                   .y_m = 2.0,
                                   .theta_rad = 0.5,
                                   .deviation_xy_m = 0.2,
                                   .deviation_theta_rad = 0.1,
                                   .map_id = "floor"},
          .actions = {}};
}

Edge edge(std::size_t index, bool released) {
  const std::string from = std::to_string(2 * index), to = std::to_string(2 * index + 2);
  return {.id = "o1.e" + std::to_string(2 * index + 1),
          .sequence = static_cast<std::uint32_t>(2 * index + 1),
          .released = released,
          .start_node = "o1.n" + from,
          .end_node = "o1.n" + to,
          .max_speed_mps = 1.5,
          .orientation_rad = 0.0,
          .rotation_allowed = false,
          .length_m = 1.5,
          .trajectory = Trajectory{1, {0.0, 0.0, 0.5, 1.0, 1.0}, {{0.0, 2.0}, {0.7, 2.1}, {1.5, 2.0}}},
          .actions = {}};
}

}  // namespace

Order sample_order() {
  Order order{.header = header(),
              .order_id = "o1",
              .update_id = 0,
              .nodes = {node(0, true), node(1, true), node(2, false)},
              .edges = {edge(0, true), edge(1, false)}};
  order.nodes[1].actions = {{.type = "pick",
                             .id = "o1.n2.a0",
                             .blocking = Blocking::Hard,
                             .parameters = {{"stationName", "rack"}, {"amount", 2.0}, {"gently", true}}}};
  order.edges[0].actions = {{.type = "beep", .id = "o1.e1.a0", .blocking = Blocking::None, .parameters = {}}};
  return order;
}

State sample_state() {
  State state;
  state.header = header();
  state.order_id = "o1";
  state.update_id = 3;
  state.last_node = "o1.n0";
  state.driving = true;
  state.new_base_request = true;
  state.mode = OperatingMode::SemiAutomatic;
  state.nodes = {{"o1.n2", 2, true}, {"o1.n4", 4, false}};
  state.edges = {{"o1.e1", 1, true}, {"o1.e3", 3, false}};
  state.position = AgvPosition{0.4, 2.0, -3.1, "floor", true};
  state.velocity = Velocity{1.2, 0.0, 0.1};
  state.loads = 1;
  state.actions = {{"o1.n2.a0", "pick", ActionStatus::Waiting, ""},
                   {"o1.e1.a0", "beep", ActionStatus::Paused, "shy"}};
  state.battery = {81.5, false};
  state.errors = {{"orderError", ErrorLevel::Warning, "no forks", {{"nodeId", "o1.n2"}}}};
  state.emergency_stop = EmergencyStop::AutoAck;
  state.field_violation = true;
  return state;
}

std::string sample_message(Topic topic) {
  switch (topic) {
    case Topic::Order:
      return to_json(sample_order());
    case Topic::InstantActions:
      return to_json(InstantActions{header(), {{"stopPause", "i1", Blocking::None, {{"reason", "lunch"}}}}});
    case Topic::State:
      return to_json(sample_state());
    case Topic::Visualization:
      return to_json(Visualization{header(), sample_state().position, sample_state().velocity});
    case Topic::Connection:
      return to_json(Connection{header(), ConnectionState::Broken});
    case Topic::Factsheet:
      return to_json(factsheet_of({}, {}, header()));
  }
  return {};
}

}  // namespace stepwright::fleet::vda5050
