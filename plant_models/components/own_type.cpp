#include "plant_models/components/own_type.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "plant_models/components/component_reader.h"
#include "plant_models/components/own_component.h"

namespace stepwright::components {
namespace {

using settings::TomlTable;

const Dimension kPressureUnit = {{-1, 1, -2, 0, 0}};
const Dimension kFlowUnit = {{3, 0, -1, 0, 0}};

Dimension per_second(Dimension dimension) {
  dimension.exponents[2] = static_cast<std::int8_t>(dimension.exponents[2] - 1);
  return dimension;
}

class OwnTypeReader {
 public:
  OwnTypeReader(const TomlTable& table, const std::string& name) : table_(table) { type_.name = name; }

  std::optional<ComponentType> read() {
    type_.meaning = table_.text("meaning", "described in the plant's file");
    type_.stages = 2;
    read_parameters(table_.table("parameters"));
    read_faults(table_.table("faults"));
    read_inputs(table_.table("inputs"));
    read_ports(table_.table("ports"));
    read_states(table_.table("states"));
    read_outputs(table_.table("outputs"));
    read_events(table_.table("events"));
    variables_ = variables_of(*equations_, values_);
    check();
    if (wrong_) return std::nullopt;
    type_.make = [equations = std::shared_ptr<const OwnEquations>(equations_)](const Parameters& p) {
      return make_own(equations, p);
    };
    return std::move(type_);
  }

 private:
  // A text with its place, to be read as an expression of that dimension once all names are known.
  struct Pending {
    std::string text;
    Dimension dimension{};
    std::string what;
    const TomlTable table;
    std::string key;
    std::size_t output = static_cast<std::size_t>(-1);
    bool is_switch = false;
  };

  Unit unit_of(const TomlTable& table) {
    const std::string text = table.text("unit", "");
    if (const auto unit = parse_unit(text)) return *unit;
    const std::string meant = unit_hint(text);
    report(table, "unit", "'" + text + "' is no unit",
           meant.empty() ? "such as \"m\", \"l/s\", \"percent\"; none for a pure number" : meant, "0341");
    return {};
  }
  void report(const TomlTable& table, const std::string& key, std::string message, std::string hint,
              const char* number) {
    wrong_ = true;
    table.report(key, std::move(message), std::move(hint), number);
  }
  void name(const TomlTable& table, const std::string& key) {
    if (!names_.insert(key).second || key == "t" || key == "type")
      report(table, key, "the name '" + key + "' is taken",
             "each parameter, input, state and fault has its own; t is the time", "0006");
  }

  void read_parameters(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      name(all, key);
      const TomlTable one = all.table(key);
      const Unit unit = unit_of(one);
      if (one.has("default") && !one.text("default", "").empty())
        (void)read_figure(one, {.name = "default", .unit = unit.text}, {});
      type_.parameters.push_back({.name = key,
                                  .unit = unit.text,
                                  .fallback = one.text("default", ""),
                                  .meaning = one.text("meaning", "")});
      equations_->parameters.push_back({key, unit.dimension});
    }
  }
  void read_faults(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      name(all, key);
      const TomlTable one = all.table(key);
      const Unit unit = unit_of(one);
      const Quantity rest =
          read_figure(one, {.name = "rest", .unit = unit.text, .fallback = "0 " + unit.text}, {});
      type_.faults.push_back({.name = key,
                              .unit = unit.text,
                              .low = one.number("low", 0.0),
                              .high = one.number("high", 1.0),
                              .rest = rest.value,
                              .meaning = one.text("meaning", "")});
      equations_->faults.push_back({key, unit.dimension});
    }
  }
  void read_inputs(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      name(all, key);
      const TomlTable one = all.table(key);
      const bool is_switch = one.boolean("switch", false);
      const Unit unit = is_switch ? Unit{} : unit_of(one);
      PortSpec port = {.name = key,
                       .kind = is_switch ? PortKind::Logic : PortKind::Signal,
                       .unit = unit.text,
                       .meaning = one.text("meaning", "")};
      if (one.has("default")) {
        port.open = Open::Constant;
        port.constant =
            is_switch
                ? truth(one)
                : read_figure(one, {.name = "default", .unit = unit.text, .fallback = "0 " + unit.text}, {})
                      .value;
      }
      equations_->reads.push_back({key, unit.dimension, {type_.ports.size(), false, false}});
      type_.ports.push_back(std::move(port));
    }
  }
  // Of a switch; in quotes, too, as constants of components are.
  double truth(const TomlTable& one) const {
    if (!one.is_text("default")) return one.boolean("default", false) ? 1.0 : 0.0;
    return one.choice("default", "false", {"true", "false"}) == "true" ? 1.0 : 0.0;
  }
  // Of liquid: a branch says what flows in, by pressures; a node says its pressure and gets what flows in.
  void read_ports(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      const TomlTable one = all.table(key);
      const bool node = one.choice("role", "branch", {"branch", "node"}) == "node";
      const std::string expression = one.required_text(node ? "pressure" : "flow");
      const std::string read = key + (node ? "_flow" : "_pressure");
      name(all, read);
      const std::size_t port = type_.ports.size();
      equations_->reads.push_back({read, node ? kFlowUnit : kPressureUnit, {port, node, true}});
      type_.ports.push_back({.name = key,
                             .kind = PortKind::Fluid,
                             .role = node ? Role::Node : Role::Branch,
                             .open = node ? Open::Fine : Open::Wrong,
                             .meaning = one.text("meaning", "")});
      add_output(one, node ? "pressure" : "flow", expression, node ? kPressureUnit : kFlowUnit,
                 {port, !node, true}, false);
    }
  }
  void read_states(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      name(all, key);
      const TomlTable one = all.table(key);
      const Unit unit = unit_of(one);
      OwnState state;
      state.name = key;
      state.dimension = unit.dimension;
      state.derivative = one.required_text("derivative");
      state.liquid = one.boolean("liquid", false);
      state.tolerance = std::abs(
          read_figure(one, {.name = "tolerance", .unit = unit.text, .fallback = "1e-6 " + unit.text}, {})
              .value);
      // A figure with its unit, or an expression.
      const std::string start = one.text("start", "0");
      const auto figure = parse_quantity(start);
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", figure ? figure->value : 0.0);
      state.start = figure ? text : start;
      state.start_where = one.where("start");
      if (figure && figure->value != 0.0 && figure->unit.dimension != unit.dimension)
        report(one, "start",
               "the unit of 'start' does not fit: " + to_string(figure->unit.dimension) + " where " +
                   to_string(unit.dimension) + " is wanted",
               "a figure in " + unit.text, "0341");
      if (!figure) pending_.push_back({start, unit.dimension, "the start of '" + key + "'", one, "start"});
      pending_.push_back({state.derivative, per_second(unit.dimension), "the derivative of '" + key + "'",
                          one, "derivative"});
      equations_->states.push_back(std::move(state));
    }
  }
  void read_outputs(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      const TomlTable one = all.table(key);
      const bool is_switch = one.boolean("switch", false);
      const Unit unit = is_switch ? Unit{} : unit_of(one);
      const std::string expression = one.required_text("value");
      const std::size_t port = type_.ports.size();
      const bool taken = std::any_of(type_.ports.begin(), type_.ports.end(),
                                     [&](const PortSpec& other) { return other.name == key; });
      if (taken)
        report(all, key, "the name '" + key + "' is taken", "inputs and outputs have different names",
               "0006");
      type_.ports.push_back({.name = key,
                             .kind = is_switch ? PortKind::Logic : PortKind::Signal,
                             .role = Role::Node,
                             .unit = unit.text,
                             .open = Open::Fine,
                             .meaning = one.text("meaning", "")});
      add_output(one, "value", expression, unit.dimension, {port, false, false}, is_switch);
    }
  }
  void add_output(const TomlTable& table, const char* key, const std::string& text,
                  const Dimension& dimension, const OwnPlace& place, bool is_switch) {
    pending_.push_back({text, dimension,
                        "'" + std::string(key) + "' of '" + type_.ports[place.port].name + "'", table, key,
                        equations_->outputs.size(), is_switch});
    equations_->outputs.push_back({text, place, 0, is_switch});
  }
  void read_events(const TomlTable& all) {
    for (const std::string& key : all.keys()) {
      const TomlTable one = all.table(key);
      OwnEvent event;
      event.name = key;
      event.when = one.required_text("when");
      event.falling = one.boolean("falling", false);
      event.rising = one.boolean("rising", !event.falling);
      const TomlTable set = one.table("set");
      if (set.keys().empty())
        report(one, "set", "event '" + key + "' sets nothing", "set = { STATE = \"...\" }: where it jumps to",
               "0349");
      for (const std::string& state : set.keys()) {
        const auto& states = equations_->states;
        const auto found = std::find_if(states.begin(), states.end(),
                                        [&](const OwnState& other) { return other.name == state; });
        const std::string text = set.text(state, "0");
        if (found == states.end()) {
          report(set, state, "'" + state + "' is no state", "an event sets states", "0349");
          continue;
        }
        pending_.push_back({text, found->dimension, "what '" + state + "' is set to", set, state});
        event.set.push_back({static_cast<std::size_t>(found - states.begin()), text});
      }
      pending_.push_back({event.when, {}, "", one, "when"});  // of any unit: it is compared with zero
      equations_->events.push_back(std::move(event));
    }
  }

  void check() {
    for (const Pending& pending : pending_) {
      const result::Location where = pending.table.where(pending.key);
      auto expression = Expression::create(pending.text, variables_, where);
      if (!expression) {
        add(pending, expression.error());
        continue;
      }
      if (pending.output != static_cast<std::size_t>(-1)) place_output(pending.output, *expression);
      if (pending.what.empty() || pending.is_switch) continue;
      if (auto fits = check_dimension(*expression, variables_, pending.dimension, pending.what, where); !fits)
        add(pending, fits.error());
    }
  }
  void add(const Pending& pending, const result::Diagnostics& problems) {
    for (const result::Diagnostic& problem : problems)
      report(pending.table, pending.key, problem.message, problem.hint,
             problem.code == kUnitCode ? "0341" : "0349");
  }
  // What reads inputs is worked out after what does not.
  void place_output(std::size_t output, const Expression& expression) {
    const std::vector<std::string> names = expression.reads();
    for (const OwnRead& read : equations_->reads) {
      if (std::find(names.begin(), names.end(), read.name) == names.end()) continue;
      equations_->outputs[output].stage = 1;
      type_.ports[read.place.port].reads = 1;
    }
    // What flows comes from a node, whose temperature is read.
    if (equations_->outputs[output].place.through) {
      equations_->outputs[output].stage = 1;
      type_.ports[equations_->outputs[output].place.port].reads = 1;
    }
    type_.ports[equations_->outputs[output].place.port].stage = equations_->outputs[output].stage;
  }

  static constexpr std::string_view kUnitCode = "C0341";
  TomlTable table_;
  ComponentType type_;
  std::shared_ptr<OwnEquations> equations_ = std::make_shared<OwnEquations>();
  std::vector<double> values_;
  std::vector<Variable> variables_;
  std::vector<Pending> pending_;
  std::set<std::string> names_;
  bool wrong_ = false;
};

}  // namespace

std::optional<ComponentType> read_own_type(const TomlTable& table, const std::string& name) {
  return OwnTypeReader(table, name).read();
}

}  // namespace stepwright::components
