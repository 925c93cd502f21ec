// Where the values of the ports are, and what is worked out from what.

#include <algorithm>

#include "plant_models/components/assembler.h"
#include "plant_models/components/floor.h"

namespace stepwright::components {
namespace {

void add_range(std::vector<std::uint32_t>& list, std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) list.push_back(first + i);
}

}  // namespace

std::uint32_t Assembler::new_values(std::uint32_t count, double value) {
  const auto first = static_cast<std::uint32_t>(model_->values.size());
  model_->values.resize(first + count, value);
  return first;
}

void Assembler::make_components() {
  for (const ComponentText& part : text_.components) {
    model_->components.push_back(part.type->make(part.parameters));
    model_->names.push_back(part.name);
    model_->types.push_back(part.type);
    const Component& made = *model_->components.back();
    for (std::size_t s = 0; s < made.state_count(); ++s) thermal_ = thermal_ || made.heat(s) != 0.0;
  }
}

void Assembler::place_nodes() {
  for (PortId port = 0; port < component_of_.size(); ++port) {
    const PortSpec& mine = spec(port);
    if (mine.role != Role::Node) continue;
    slots_[port] = {new_values(across_size(mine.kind)), 0, used_[port]};
  }
}

void Assembler::place_open(PortId port) {
  const PortSpec& mine = spec(port);
  slots_[port].across = new_values(across_size(mine.kind), mine.constant);
  if (mine.kind != PortKind::Fluid) return;
  const double room_k = text_.components.front().parameters.room_k;
  model_->values[slots_[port].across + kAvailable] = 1.0;
  model_->values[slots_[port].across + kTemperature] = room_k;
}

void Assembler::place_branches() {
  for (PortId port = 0; port < component_of_.size(); ++port) {
    const PortSpec& mine = spec(port);
    if (mine.role != Role::Branch) continue;
    if (!is_signal(mine.kind)) slots_[port].through = new_values(through_size(mine.kind));
    if (mine.open == Open::Floor && !used_[port]) join(port, first_port_[*find_component("floor")]);
    slots_[port].connected = used_[port];
    if (source_[port] != kNone) {
      slots_[port].across = slots_[source_[port]].across;
    } else if (terminal_[port] != kNone) {
      slots_[port].across = actuator_slot_[terminal_[port]];
    } else if (!used_[port]) {
      place_open(port);
    }
  }
  for (PortId port = 0; port < component_of_.size(); ++port) {
    if (used_[port] && !is_signal(spec(port).kind)) nets_[root_of(port)].push_back(port);
  }
}

// Gives each net its node, which it may have to be given.
void Assembler::place_junctions() {
  for (const auto& [root, ports] : nets_) {
    std::vector<PortId> nodes;
    std::vector<PortId> branches;
    for (const PortId port : ports) (spec(port).role == Role::Node ? nodes : branches).push_back(port);
    if (nodes.size() > 1) {
      report("C0347", where_[nodes[0]],
             "'" + name_of(nodes[0]) + "' and '" + name_of(nodes[1]) +
                 "' cannot be joined as they are: both say what is there",
             "put a pipe, a pump or a valve between them");
      continue;
    }
    const PortKind kind = spec(ports.front()).kind;
    std::uint32_t across = 0;
    if (nodes.empty()) {
      across = new_values(across_size(kind));
      if (kind == PortKind::Fluid) {
        model_->values[across + kAvailable] = 1.0;
        model_->values[across + kTemperature] = text_.components.front().parameters.room_k;
      } else if (kind == PortKind::Heat) {
        model_->values[across] = text_.components.front().parameters.room_k;
        model_->values[across + kContact] = 1.0;
      }
    } else {
      across = slots_[nodes.front()].across;
    }
    for (const PortId branch : branches) slots_[branch].across = across;
    const std::uint32_t through = gather(branches, kind);
    if (!nodes.empty()) {
      slots_[nodes.front()].through = through;
      continue;
    }
    OrderNode junction;
    junction.unknown = true;
    junction.component = component_of_[branches.front()];
    junction.writes.push_back(across);
    junction.reads.push_back(through);
    junction.typical.push_back(kind == PortKind::Fluid ? 1e5 : kind == PortKind::Heat ? 300.0 : 100.0);
    junction.typical_residual.push_back(kind == PortKind::Fluid ? 1e-4 : kind == PortKind::Heat ? 1e3 : 10.0);
    if (kind == PortKind::Fluid && thermal_) {
      junction.writes.push_back(across + kTemperature);
      junction.reads.push_back(through + kHeatFlow);
      junction.typical.push_back(300.0);
      junction.typical_residual.push_back(3e-2);
    }
    junctions_.push_back(std::move(junction));
  }
}

// The place with the sum of what the branches let flow.
std::uint32_t Assembler::gather(const std::vector<PortId>& branches, PortKind kind) {
  if (branches.empty()) return 0;
  if (branches.size() == 1) return slots_[branches.front()].through;
  const std::uint32_t size = through_size(kind);
  const std::uint32_t through = new_values(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    if (i == kHeatFlow && kind == PortKind::Fluid && !thermal_) continue;
    Gathering gathering;
    gathering.to = through + i;
    for (const PortId branch : branches) gathering.from.push_back(slots_[branch].through + i);
    OrderNode node;
    node.step = {StepKind::Gather, static_cast<std::uint32_t>(model_->gatherings.size()), 0};
    node.reads = gathering.from;
    node.writes = {gathering.to};
    gathers_.push_back(std::move(node));
    model_->gatherings.push_back(std::move(gathering));
  }
  return through;
}

void Assembler::list_order() {
  std::vector<OrderNode> nodes;
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) {
    const ComponentType& type = *text_.components[c].type;
    for (std::uint32_t stage = 0; stage < type.stages; ++stage) {
      OrderNode node;
      node.step = {StepKind::Evaluate, c, stage};
      node.component = c;
      for (std::uint32_t i = 0; i < type.ports.size(); ++i) {
        const PortSpec& port = type.ports[i];
        const PortSlots& slots = slots_[first_port_[c] + i];
        const bool branch = port.role == Role::Branch;
        const std::uint32_t across = across_size(port.kind);
        const std::uint32_t through = through_size(port.kind);
        if (port.reads <= stage) {
          branch ? add_range(node.reads, slots.across, across)
                 : add_range(node.reads, slots.through, through);
        }
        if (port.stage != stage) continue;
        branch ? add_range(node.writes, slots.through, through)
               : add_range(node.writes, slots.across, across);
      }
      nodes.push_back(std::move(node));
    }
  }
  nodes.insert(nodes.end(), gathers_.begin(), gathers_.end());
  nodes.insert(nodes.end(), junctions_.begin(), junctions_.end());
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) bind_component(c);
  if (auto ordered = put_in_order(nodes, *model_); !ordered)
    problems_.insert(problems_.end(), ordered.error().begin(), ordered.error().end());
}

void Assembler::bind_component(std::uint32_t c) {
  Model& model = *model_;
  Component& component = *model.components[c];
  const ComponentType& type = *text_.components[c].type;
  const auto first = slots_.begin() + first_port_[c];
  std::vector<double> faults;
  for (std::uint32_t i = 0; i < type.faults.size(); ++i) {
    const FaultSpec& fault = type.faults[i];
    faults.push_back(fault.rest);
    if (!text_.components[c].parameters.has(fault.needs)) continue;
    model.faults.push_back({text_.components[c].name + "." + fault.name, fault.unit, fault.meaning});
    const double factor = parse_unit(fault.unit).value_or(Unit{}).factor;
    model.fault_at.push_back({c, i, factor, fault.low, fault.high, fault.rest, fault.usual, fault.whole});
  }
  model.first_state.push_back(static_cast<std::uint32_t>(model.states));
  model.first_root.push_back(static_cast<std::uint32_t>(model.roots));
  component.bind({first, first + static_cast<std::ptrdiff_t>(type.ports.size())}, model.states,
                 std::move(faults));
  if (component.state_count() > 0) model.with_states.push_back(c);
  if (component.root_count() > 0) model.with_roots.push_back(c);
  if (ProcessPart* const process = component.process(); process != nullptr)
    model.processes.push_back(process);
  model.states += component.state_count();
  model.roots += component.root_count();
}

}  // namespace stepwright::components
