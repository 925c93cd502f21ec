// What is seen of the plant from outside: terminals, truths and faults.

#include <algorithm>
#include <map>
#include <vector>

#include "plant_models/components/assembler.h"
#include "plant_models/components/component_reader.h"
#include "plant_models/core/names.h"
#include "runtime/ground/naming/direct_address.h"

namespace stepwright::components {
namespace {

// The bits of an area that an address takes.
std::pair<std::uint64_t, std::uint64_t> bits_of(const naming::DirectAddress& address) {
  const std::uint64_t first = std::uint64_t{address.byte} * 8 + address.bit;
  return {first, first + address.bits};
}

bool overlap(const naming::DirectAddress& a, const naming::DirectAddress& b) {
  return a.area == b.area && bits_of(a).first < bits_of(b).second && bits_of(b).first < bits_of(a).second;
}

}  // namespace

void Assembler::read_terminals() {
  std::vector<std::pair<const TerminalText*, naming::DirectAddress>> taken;
  for (const TerminalText& terminal : text_.terminals) {
    if (find_component(terminal.name))
      report("C0348", terminal.where, "'" + terminal.name + "' is the name of a component, too",
             "choose another name for the terminal");
    const auto address = naming::parse_direct_address(terminal.address);
    const bool drives = terminal.from.empty();
    const bool fits = address && (address->bits == 1 || address->bits == 16) &&
                      address->area == (drives ? naming::Area::Output : naming::Area::Input);
    if (!fits) {
      report("C0348", terminal.where, "'" + terminal.address + "' is no address for '" + terminal.name + "'",
             drives ? "what the program drives is at %QX0.0 or %QW1; what it reads has a 'from' as well"
                    : "what the program reads is at %IX0.0 or %IW1");
      continue;
    }
    // As of every wire (bridge/port_map.h), here with its place in the plant's own file.
    for (const auto& [before, at] : taken) {
      if (overlap(at, *address))
        report(
            "C0304", terminal.where,
            terminal.address + " overlaps " + before->address + ", to which '" + before->name + "' is wired",
            "%IW1 is bytes 2 and 3: bits and words share the area");
    }
    taken.emplace_back(&terminal, *address);
    if (!drives) continue;
    const auto kind = address->bits == 1 ? core::PortKind::Bool : core::PortKind::Count;
    terminal_by_name_.emplace(terminal.name, static_cast<std::uint32_t>(model_->actuators.size()));
    actuator_slot_.push_back(new_values(1));
    model_->actuators.push_back({terminal.name, kind, {}});
    model_->actuator_at.push_back({actuator_slot_.back(), terminal.address, terminal.where});
  }
}

std::optional<Assembler::PortId> Assembler::find_output(const std::string& text,
                                                        const result::Location& where) {
  const std::string name = whole_name(text, {});
  const auto output_of = [&](std::uint32_t component, std::string_view port) -> std::optional<PortId> {
    const auto& ports = text_.components[component].type->ports;
    for (std::uint32_t i = 0; i < ports.size(); ++i) {
      const bool signal = ports[i].kind == PortKind::Signal || ports[i].kind == PortKind::Logic;
      if (signal && ports[i].role == Role::Node && (port.empty() || ports[i].name == port))
        return first_port_[component] + i;
    }
    return std::nullopt;
  };
  std::optional<PortId> found;
  std::vector<std::string> known;
  if (const auto whole = find_component(name)) {
    found = output_of(*whole, {});
  } else if (const auto split = split_name(name)) {
    const ComponentText& part = text_.components[split->first];
    found = output_of(split->first, split->second);
    for (const PortSpec& port : part.type->ports)
      if (port.role == Role::Node && is_signal(port.kind)) known.push_back(part.name + "." + port.name);
  } else {
    known = known_names();
  }
  if (!found) report("C0343", where, "there is no output '" + text + "'", meant_or(text, known));
  return found;
}

// Before it is looked for open ports: what a terminal shows is connected.
void Assembler::check_terminals() {
  std::vector<bool> driven(model_->actuators.size(), false);
  for (PortId port = 0; port < component_of_.size(); ++port) {
    if (terminal_[port] == kNone) continue;
    driven[terminal_[port]] = true;
    std::string& meaning = model_->actuators[terminal_[port]].meaning;
    meaning += (meaning.empty() ? "drives " : ", ") + name_of(port);
  }
  for (std::size_t i = 0; i < driven.size(); ++i) {
    if (driven[i]) continue;
    const core::Port& terminal = model_->actuators[i];
    report("C0344", model_->actuator_at[i].where, "terminal '" + terminal.name + "' drives nothing",
           "name it at the port that it drives, such as command = \"" + terminal.name + "\"");
  }
  for (const TerminalText& terminal : text_.terminals) {
    const auto address = naming::parse_direct_address(terminal.address);
    if (terminal.from.empty() || !address) continue;
    const auto port = find_output(terminal.from, terminal.where);
    if (!port || !is_there(*port, terminal.where)) continue;
    used_[*port] = true;
    const bool bit = address->bits == 1;
    if (bit != (spec(*port).kind == PortKind::Logic)) {
      report("C0347", terminal.where, "'" + name_of(*port) + "' does not fit " + terminal.address,
             bit ? "a switch is at a bit; a signal at a %IW" : "a signal is at a word; a switch at a %IX");
    } else if (!bit && !unit_[*port].dimension.none()) {
      report(
          "C0341", terminal.where,
          "'" + name_of(*port) + "' is in " + unit_[*port].text + ", and " + terminal.address + " has counts",
          "an analog_input between them turns " + unit_[*port].text + " into counts");
    }
    model_->sensors.push_back(
        {terminal.name, bit ? core::PortKind::Bool : core::PortKind::Count, "shows " + name_of(*port)});
    model_->sensor_at.push_back({0, terminal.address, terminal.where});
    sensor_port_.push_back(*port);
  }
}

void Assembler::list_terminals() {
  for (std::size_t i = 0; i < sensor_port_.size(); ++i)
    model_->sensor_at[i].slot = slots_[sensor_port_[i]].across;
}

void Assembler::list_reports() {
  Model& model = *model_;
  for (PortId port = 0; port < component_of_.size(); ++port) {
    const PortSpec& mine = spec(port);
    if (mine.role != Role::Node || (mine.kind != PortKind::Signal && mine.kind != PortKind::Logic)) continue;
    if (!text_.components[component_of_[port]].parameters.has(mine.needs)) continue;
    model.truths.push_back({name_of(port), unit_[port].text, mine.meaning});
    model.truth_at.push_back({slots_[port].across, unit_[port].factor, unit_[port].offset});
  }
  if (find_component("floor")) {
    model.truths.push_back(
        {"plant.liquid", "l", "all liquid, also on the floor and beyond sources and sinks: constant"});
    model.truth_at.push_back({kAllLiquid, 1e-3, 0.0});
  }
  add_aliases();
}

void Assembler::add_aliases() {
  Model& model = *model_;
  for (const AliasText& alias : text_.truths) {
    const auto found = core::index_of(model.truths, whole_name(alias.of, {}));
    if (!found) {
      report("C0343", alias.where, "there is no value '" + alias.of + "'",
             meant_or(alias.of, core::names_of(model.truths)));
      continue;
    }
    core::Quantity truth = model.truths[*found];
    ModelTruth at = model.truth_at[*found];
    truth.name = alias.name;
    if (alias.factor != 1.0) {
      truth.unit = alias.unit;
      at.factor /= alias.factor;
    } else if (!alias.unit.empty()) {
      const auto unit = parse_unit(alias.unit);
      const auto now = parse_unit(truth.unit);
      if (!unit || !now || unit->dimension != now->dimension) {
        report("C0341", alias.where, "'" + alias.of + "' cannot be said in " + alias.unit,
               "it is in " + truth.unit);
        continue;
      }
      truth.unit = alias.unit;
      at.factor = unit->factor;
      at.offset = unit->offset;
    }
    model.truths.push_back(std::move(truth));
    model.truth_at.push_back(at);
  }
  std::map<std::string, std::string> named;
  for (const AliasText& alias : text_.faults) {
    const auto found = core::index_of(model.faults, alias.of);
    if (!found) {
      report("C0343", alias.where, "there is no fault '" + alias.of + "'", fault_hint(model, alias.of));
      continue;
    }
    const auto same = std::ranges::find(named, alias.of, &std::pair<const std::string, std::string>::second);
    if (same != named.end()) {
      report("C0343", alias.where, "'" + alias.of + "' is another name of '" + same->first + "'",
             "one other name for each fault");
      continue;
    }
    const auto [other, is_new] = named.emplace(alias.of, alias.name);
    if (!is_new) {
      report("C0343", alias.where, "'" + alias.of + "' has another name already: '" + other->second + "'",
             "one other name for each fault");
      continue;
    }
    core::Quantity fault = model.faults[*found];
    ModelFault at = model.fault_at[*found];
    fault.name = alias.name;
    if (alias.factor != 1.0) {
      fault.unit = alias.unit;
      at.factor /= alias.factor;
      at.low *= alias.factor;
      at.high *= alias.factor;
      at.usual *= alias.factor;
    }
    model.faults.push_back(std::move(fault));
    model.fault_at.push_back(at);
  }
}

std::vector<double> Model::start() const {
  std::vector<double> y;
  for (const auto& component : components)
    for (std::size_t s = 0; s < component->state_count(); ++s) y.push_back(component->start(s));
  return y;
}

std::vector<double> Model::tolerances() const {
  std::vector<double> tolerance;
  for (const auto& component : components)
    for (std::size_t s = 0; s < component->state_count(); ++s) tolerance.push_back(component->tolerance(s));
  return tolerance;
}

}  // namespace stepwright::components
