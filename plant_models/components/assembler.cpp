#include "plant_models/components/assembler.h"

#include <algorithm>

#include "plant_models/components/component_reader.h"
#include "plant_models/components/floor.h"

namespace stepwright::components {
namespace {

const char* word_of(PortKind kind) {
  switch (kind) {
    case PortKind::Fluid:
      return "a liquid";
    case PortKind::Heat:
      return "heat";
    case PortKind::Rotation:
      return "a shaft";
    case PortKind::Signal:
      return "a signal";
    case PortKind::Logic:
      return "a switch";
  }
  return "";
}

// The port whose unit a parameter has.
std::string like_of(const ComponentType& type, const std::string& parameter) {
  for (const ParameterSpec& spec : type.parameters)
    if (spec.name == parameter) return spec.like;
  return {};
}

}  // namespace

Assembler::Assembler(ModelText text) : model_(std::make_unique<Model>()), text_(model_->text) {
  text_ = std::move(text);
}

void Assembler::report(const char* code, result::Location where, std::string message, std::string hint) {
  problems_.push_back({code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
}

void Assembler::add_floor() {
  const bool liquid =
      std::any_of(text_.components.begin(), text_.components.end(), [](const ComponentText& part) {
        return std::any_of(part.type->ports.begin(), part.type->ports.end(),
                           [](const PortSpec& port) { return port.kind == PortKind::Fluid; });
      });
  if (!liquid) return;
  for (const ComponentText& part : text_.components) {
    if (part.name == "floor")
      report("C0347", part.place, "'floor' is the floor of the plant, which is there anyway",
             "choose another name");
  }
  ComponentText floor;
  floor.name = "floor";
  floor.type = &floor_type();
  floor.parameters = text_.components.front().parameters;
  text_.components.push_back(std::move(floor));
}

void Assembler::number_ports() {
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) {
    const ComponentText& part = text_.components[c];
    by_name_.emplace(part.name, c);
    first_port_.push_back(static_cast<PortId>(component_of_.size()));
    for (const PortSpec& port : part.type->ports) {
      component_of_.push_back(c);
      where_.push_back(part.place);
      parent_.push_back(static_cast<PortId>(parent_.size()));
      unit_.push_back(parse_unit(port.unit).value_or(Unit{}));
    }
  }
  const std::size_t ports = component_of_.size();
  source_.assign(ports, kNone);
  terminal_.assign(ports, kNone);
  used_.assign(ports, false);
  constant_.assign(ports, false);
  slots_.assign(ports, {});
}

const PortSpec& Assembler::spec(PortId port) const {
  const std::uint32_t component = component_of_[port];
  return text_.components[component].type->ports[port - first_port_[component]];
}

std::string Assembler::name_of(PortId port) const {
  return text_.components[component_of_[port]].name + "." + spec(port).name;
}

Assembler::PortId Assembler::root_of(PortId port) {
  while (parent_[port] != port) port = parent_[port] = parent_[parent_[port]];
  return port;
}

void Assembler::join(PortId a, PortId b) {
  parent_[root_of(a)] = root_of(b);
  used_[a] = used_[b] = true;
}

std::vector<std::string> Assembler::known_names() const {
  std::vector<std::string> names;
  for (const ComponentText& part : text_.components) names.push_back(part.name);
  for (const TerminalText& terminal : text_.terminals) names.push_back(terminal.name);
  return names;
}

// A name with those of assemblies' ports replaced by what they are.
std::string Assembler::whole_name(const std::string& text, const std::string& prefix) const {
  std::string name = prefix + text;
  for (int deep = 0; deep < 16; ++deep) {
    const auto found = text_.port_names.find(name);
    if (found == text_.port_names.end()) break;
    name = found->second;
  }
  return name;
}

std::optional<std::uint32_t> Assembler::find_component(const std::string& name) const {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return std::nullopt;
  return found->second;
}

std::optional<std::pair<std::uint32_t, std::string>> Assembler::split_name(const std::string& name) const {
  for (std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0;
       dot = name.rfind('.', dot - 1)) {
    if (const auto component = find_component(name.substr(0, dot)))
      return std::pair(*component, name.substr(dot + 1));
  }
  return std::nullopt;
}

// The port of a component that fits where none is named.
std::optional<Assembler::PortId> Assembler::default_port(std::uint32_t component, PortId from,
                                                         const result::Location& where) {
  const PortSpec& mine = spec(from);
  const auto& ports = text_.components[component].type->ports;
  std::vector<PortId> fitting;
  const auto collect = [&](Role role) {
    for (std::uint32_t i = 0; i < ports.size(); ++i) {
      const PortId port = first_port_[component] + i;
      if (ports[i].kind != mine.kind || ports[i].role != role) continue;
      const bool other_unit = is_signal(mine.kind) && mine.unit != "any" && ports[i].unit != "any" &&
                              unit_[port].dimension != unit_[from].dimension;
      if (!other_unit) fitting.push_back(port);
    }
  };
  collect(mine.role == Role::Branch ? Role::Node : Role::Branch);
  if (fitting.empty() && !is_signal(mine.kind) && mine.role == Role::Branch) collect(Role::Branch);
  // The first output of a component is the one that it is there for.
  if (!fitting.empty() && (fitting.size() == 1 || is_signal(mine.kind))) return fitting.front();
  std::string names;
  for (std::uint32_t i = 0; i < ports.size(); ++i) {
    if (ports[i].kind == mine.kind) names += (names.empty() ? "" : ", ") + ports[i].name;
  }
  const std::string& name = text_.components[component].name;
  report("C0343", where,
         fitting.empty()
             ? "'" + name + "' has no port for " + word_of(mine.kind) + " that fits '" + name_of(from) + "'"
             : "'" + name + "' has several ports for " + word_of(mine.kind),
         names.empty() ? "a " + text_.components[component].type->name + " has none of that kind"
                       : "write \"" + name + ".PORT\" with one of: " + names);
  return std::nullopt;
}

std::optional<Assembler::PortId> Assembler::find_port(const ConnectionText& connection, PortId from) {
  const std::string name = whole_name(connection.to, connection.prefix);
  if (const auto component = find_component(name)) return default_port(*component, from, connection.where);
  const auto split = split_name(name);
  if (!split) {
    std::string hint = meant_or(connection.to, known_names());
    if (is_signal(spec(from).kind)) hint += "; a terminal stands in [terminals]";
    report("C0343", connection.where,
           "there is no '" + connection.to + "' that '" + name_of(from) + "' could be connected to",
           std::move(hint));
    return std::nullopt;
  }
  const auto& [component, port] = *split;
  const ComponentText& part = text_.components[component];
  std::vector<std::string> known;
  for (std::uint32_t i = 0; i < part.type->ports.size(); ++i) {
    if (part.type->ports[i].name == port) return first_port_[component] + i;
    known.push_back(part.type->ports[i].name);
  }
  report("C0343", connection.where,
         "'" + part.name + "' (" + part.type->name + ") has no port '" + port + "'", meant_or(port, known));
  return std::nullopt;
}

// Some outputs are there with a choice of a parameter only.
bool Assembler::is_there(PortId port, const result::Location& where) {
  const ComponentText& part = text_.components[component_of_[port]];
  const NeededChoice& needed = spec(port).needs;
  if (part.parameters.has(needed)) return true;
  report("C0343", where,
         "'" + part.name + "' has '" + spec(port).name + "' with " + needed.parameter + " = \"" +
             needed.choice + "\" only",
         needed.parameter + " = \"" + needed.choice + "\" in [components." + part.name + "]");
  return false;
}

void Assembler::set_constant(PortId input, const ConnectionText& connection) {
  const PortSpec& port = spec(input);
  auto figure = parse_quantity(connection.to);
  const auto hint = [&](const char* without_unit) {
    const std::string meant = unit_hint(connection.to);
    if (!meant.empty()) return meant;
    return port.unit.empty() ? std::string(without_unit) : "such as \"1 " + port.unit + "\"";
  };
  if (connection.to == "true" || connection.to == "false")
    figure = Quantity{connection.to == "true" ? 1.0 : 0.0, Unit{}};
  if (!figure) {
    report("C0341", connection.where, "'" + connection.to + "' is no figure with a unit",
           hint("a number, or the name of an output"));
    return;
  }
  if (port.unit == "any") unit_[input] = figure->unit;
  if (figure->unit.dimension != unit_[input].dimension) {
    report("C0341", connection.where,
           "the unit does not fit '" + name_of(input) + "': " + to_string(figure->unit.dimension) +
               " where " + to_string(unit_[input].dimension) + " is wanted",
           hint("a pure number"));
    return;
  }
  used_[input] = constant_[input] = true;
  slots_[input] = {new_values(1, figure->value), 0, true};
}

void Assembler::connect_signal(PortId input, const ConnectionText& connection) {
  const char first = connection.to.front();
  if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.' ||
      connection.to == "true" || connection.to == "false") {
    return set_constant(input, connection);
  }
  if (const auto terminal = terminal_by_name_.find(connection.to); terminal != terminal_by_name_.end()) {
    const core::Port& port = model_->actuators[terminal->second];
    const bool fits = (port.kind == core::PortKind::Bool) == (spec(input).kind == PortKind::Logic);
    if (!fits) {
      report("C0347", connection.where,
             "terminal '" + port.name + "' is " +
                 (port.kind == core::PortKind::Bool ? "a switch, and '" : "a number, and '") +
                 name_of(input) + "' takes " + word_of(spec(input).kind),
             port.kind == core::PortKind::Bool ? "a %QX drives a switch"
                                               : "a %QW drives a signal, through an analog_output");
      return;
    }
    if (spec(input).unit == "any") unit_[input] = Unit{};
    if (!unit_[input].dimension.none()) {
      report(
          "C0341", connection.where,
          "terminal '" + port.name + "' is a number, and '" + name_of(input) + "' wants " + unit_[input].text,
          "an analog_output between them turns counts into " + unit_[input].text);
      return;
    }
    terminal_[input] = terminal->second;
    used_[input] = true;
    return;
  }
  const auto output = find_port(connection, input);
  if (output && is_there(*output, connection.where)) connect_signal_to(input, *output, connection.where);
}

void Assembler::connect_signal_to(PortId input, PortId output, const result::Location& where) {
  const PortSpec& from = spec(output);
  const PortSpec& to = spec(input);
  if (from.role != Role::Node || from.kind != to.kind) {
    report("C0347", where,
           "'" + name_of(input) + "' takes " + word_of(to.kind) + ", and '" + name_of(output) + "' is " +
               (from.role == Role::Node ? word_of(from.kind) : "no output"),
           "an output of the same kind");
    return;
  }
  source_[input] = output;
  model_->links.push_back({component_of_[output], component_of_[input], to.kind});
  used_[input] = used_[output] = true;
  where_[input] = where;
}

// Liquid comes in at the first of the ends that a component has to have joined.
void Assembler::note_link(PortId port, PortId other) {
  const std::uint32_t mine = component_of_[port];
  const auto& ports = text_.components[mine].type->ports;
  const auto first = std::find_if(ports.begin(), ports.end(), [](const PortSpec& one) {
    return one.kind == PortKind::Fluid && one.role == Role::Branch && one.open == Open::Wrong;
  });
  const bool inlet = static_cast<PortId>(first - ports.begin()) + first_port_[mine] == port;
  const std::uint32_t theirs = component_of_[other];
  model_->links.push_back({inlet ? theirs : mine, inlet ? mine : theirs, spec(port).kind});
}

void Assembler::connect() {
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) {
    for (const ConnectionText& connection : text_.components[c].connections) {
      const PortId port = first_port_[c] + static_cast<PortId>(connection.port);
      const PortSpec& mine = spec(port);
      where_[port] = connection.where;
      if (is_signal(mine.kind)) {
        if (mine.role == Role::Branch) {
          connect_signal(port, connection);
        } else {
          report("C0347", connection.where, "'" + name_of(port) + "' is an output",
                 "connect the input that it goes to: PORT = \"" + name_of(port) + "\" there");
        }
        continue;
      }
      const auto other = find_port(connection, port);
      if (!other) continue;
      if (spec(*other).kind != mine.kind) {
        report("C0347", connection.where,
               "'" + name_of(port) + "' is for " + word_of(mine.kind) + " and '" + name_of(*other) +
                   "' for " + word_of(spec(*other).kind),
               "ports that are joined are of one kind");
        continue;
      }
      join(port, *other);
      note_link(port, *other);
    }
  }
}

void Assembler::resolve_any_units() {
  // A unit goes on through components that have any; as often as there are such in a row.
  for (std::size_t round = 0; round < text_.components.size() + 1; ++round) {
    bool changed = false;
    for (PortId port = 0; port < component_of_.size(); ++port) {
      const PortSpec& mine = spec(port);
      if (mine.unit != "any" || !unit_[port].text.empty()) continue;
      if (mine.role == Role::Branch && source_[port] != kNone && !unit_[source_[port]].text.empty()) {
        unit_[port] = unit_[source_[port]];
        changed = true;
      }
      if (mine.role != Role::Node) continue;
      const std::uint32_t component = component_of_[port];
      for (const auto& [parameter, unit] : text_.components[component].units) {
        if (like_of(*text_.components[component].type, parameter) != mine.name || unit.text.empty()) continue;
        unit_[port] = unit;
        changed = true;
      }
      const auto& ports = text_.components[component].type->ports;
      for (std::uint32_t i = 0; i < ports.size(); ++i) {
        const PortId input = first_port_[component] + i;
        if (ports[i].name != mine.same_as || unit_[input].text.empty()) continue;
        unit_[port] = unit_[input];
        changed = true;
      }
    }
    if (!changed) break;
  }
  for (PortId port = 0; port < component_of_.size(); ++port) {
    if (source_[port] == kNone || unit_[port].dimension == unit_[source_[port]].dimension) continue;
    report(
        "C0341", where_[port],
        "the units of '" + name_of(source_[port]) + "' and '" + name_of(port) + "' do not fit: " +
            to_string(unit_[source_[port]].dimension) + " and " + to_string(unit_[port].dimension),
        "'" + name_of(port) + "' wants " + (unit_[port].text.empty() ? "a pure number" : unit_[port].text));
  }
}

void Assembler::check_like_units() {
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) {
    const ComponentText& part = text_.components[c];
    for (const ParameterSpec& parameter : part.type->parameters) {
      if (parameter.like.empty()) continue;
      for (std::uint32_t i = 0; i < part.type->ports.size(); ++i) {
        if (part.type->ports[i].name != parameter.like) continue;
        const Unit& wanted = unit_[first_port_[c] + i];
        const Dimension& given = part.units.find(parameter.name)->second.dimension;
        if (!used_[first_port_[c] + i] && part.type->ports[i].role == Role::Branch) continue;
        if (given == wanted.dimension) continue;
        report("C0341", part.where.find(parameter.name)->second,
               "the unit of '" + parameter.name + "' does not fit: " + to_string(given) + " where '" +
                   name_of(first_port_[c] + i) + "' is " + to_string(wanted.dimension),
               wanted.text.empty() ? "a pure number" : "a figure in " + wanted.text);
      }
    }
  }
}

void Assembler::check_open() {
  constexpr std::size_t kMost = 20;
  std::size_t more = 0;
  for (std::uint32_t c = 0; c < text_.components.size(); ++c) {
    const ComponentText& part = text_.components[c];
    if (part.type == &floor_type()) continue;
    const auto first = used_.begin() + first_port_[c];
    const bool any = std::find(first, first + static_cast<std::ptrdiff_t>(part.type->ports.size()), true) !=
                     first + static_cast<std::ptrdiff_t>(part.type->ports.size());
    if (!any) {
      std::string names;
      for (const PortSpec& port : part.type->ports) names += (names.empty() ? "" : ", ") + port.name;
      if (problems_.size() < kMost)
        report("C0345", part.place, "'" + part.name + "' is connected to nothing", "its ports: " + names);
      else
        ++more;
      continue;
    }
    for (std::uint32_t i = 0; i < part.type->ports.size(); ++i) {
      const PortSpec& port = part.type->ports[i];
      if (used_[first_port_[c] + i] || port.open != Open::Wrong) continue;
      if (problems_.size() < kMost)
        report("C0344", part.place, "port '" + part.name + "." + port.name + "' is open",
               port.name + " = \"...\": " + port.meaning);
      else
        ++more;
    }
  }
  if (more > 0)
    report("C0345", {text_.file.string(), 0, 0},
           std::to_string(more) + " more ports are open or components unconnected",
           "the first ones are above");
}

result::Result<std::unique_ptr<Model>> Assembler::run() {
  add_floor();
  number_ports();
  model_->values.assign(kFluidThrough, 0.0);  // what flows where nothing is joined
  read_terminals();
  connect();
  resolve_any_units();
  check_terminals();
  if (problems_.empty()) check_like_units();
  if (problems_.empty()) check_open();
  if (problems_.empty()) {
    make_components();
    place_nodes();
    place_branches();
    place_junctions();
  }
  if (problems_.empty()) {
    list_terminals();
    list_order();
  }
  if (problems_.empty()) list_reports();
  if (!problems_.empty()) return tl::unexpected(std::move(problems_));
  return std::move(model_);
}

result::Result<std::unique_ptr<Model>> assemble(ModelText text) {
  return Assembler(std::move(text)).run();
}

}  // namespace stepwright::components
