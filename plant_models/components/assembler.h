#pragma once

// Puts a plant's parts together: finds what each port is connected to, gives every value its place and lists
// what is worked out. One object for one plant; see assemble().

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plant_models/components/model.h"
#include "plant_models/components/model_order.h"

namespace stepwright::components {

class Assembler {
 public:
  explicit Assembler(ModelText text);
  [[nodiscard]] result::Result<std::unique_ptr<Model>> run();

 private:
  using PortId = std::uint32_t;  // over all components, in their order
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  // Names.
  void add_floor();
  void number_ports();
  std::string whole_name(const std::string& text, const std::string& prefix) const;
  std::optional<PortId> find_port(const ConnectionText& connection, PortId from);
  std::optional<PortId> default_port(std::uint32_t component, PortId from, const result::Location& where);
  std::optional<std::uint32_t> find_component(const std::string& name) const;
  // "station.p1.in" as the component and what is behind its name, which may have dots, too.
  std::optional<std::pair<std::uint32_t, std::string>> split_name(const std::string& name) const;
  std::vector<std::string> known_names() const;

  // Connections.
  void read_terminals();
  void connect();
  void note_link(PortId port, PortId other);
  void connect_signal(PortId input, const ConnectionText& connection);
  void connect_signal_to(PortId input, PortId output, const result::Location& where);
  void set_constant(PortId input, const ConnectionText& connection);
  void resolve_any_units();
  void check_like_units();
  void check_open();

  // Places.
  void place_nodes();
  void place_branches();
  void place_junctions();
  void place_open(PortId port);
  std::uint32_t gather(const std::vector<PortId>& branches, PortKind kind);
  std::uint32_t new_values(std::uint32_t count, double value = 0.0);

  // What is worked out.
  void make_components();
  void list_order();
  void bind_component(std::uint32_t component);
  void list_reports();
  void add_aliases();
  std::optional<PortId> find_output(const std::string& text, const result::Location& where);
  bool is_there(PortId port, const result::Location& where);
  void check_terminals();
  void list_terminals();

  PortId root_of(PortId port);
  void join(PortId a, PortId b);
  const PortSpec& spec(PortId port) const;
  std::string name_of(PortId port) const;
  const result::Location& place_of(PortId port) const { return where_[port]; }
  void report(const char* code, result::Location where, std::string message, std::string hint);

  std::unique_ptr<Model> model_;
  ModelText& text_;
  result::Diagnostics problems_;
  std::map<std::string, std::uint32_t, std::less<>> by_name_;
  std::map<std::string, std::uint32_t, std::less<>> terminal_by_name_;
  std::vector<PortId> first_port_;           // of each component
  std::vector<std::uint32_t> component_of_;  // of each port
  std::vector<result::Location> where_;      // where a port is connected
  std::vector<PortId> parent_;               // union of what is joined
  std::vector<PortId> source_;               // of a signal input: the output
  std::vector<std::uint32_t> terminal_;      // of a signal input: the terminal
  std::vector<bool> used_;
  std::vector<bool> constant_;
  std::vector<Unit> unit_;  // of a signal
  std::vector<PortSlots> slots_;
  std::vector<std::uint32_t> actuator_slot_;  // of a terminal that drives
  std::vector<PortId> sensor_port_;           // of a terminal that shows
  std::vector<OrderNode> junctions_;
  std::vector<OrderNode> gathers_;
  bool thermal_ = false;  // temperatures change
  std::map<PortId, std::vector<PortId>> nets_;
};

}  // namespace stepwright::components
