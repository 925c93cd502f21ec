// The type "fmu": each component of it has the ports that its FMU has.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "plant_models/components/component_reader.h"
#include "plant_models/components/library/fmu_part.h"
#include "plant_models/components/library/fmu_units.h"
#include "plant_models/components/library/types.h"
#include "plant_models/fmu/fmu_call.h"
#include "plant_models/fmu/fmu_file.h"
#include "plant_models/fmu/fmu_wiring.h"

namespace stepwright::components::library {
namespace {

using fmu::ModelVariable;
using fmu::VariableUse;
using settings::TomlTable;

// Keys of a component that stand for no variable.
constexpr std::array<std::string_view, 8> kKeys = {"type",    "file",  "parameters", "faults",
                                                   "outputs", "units", "timeout",    "start_timeout"};

// A code as TomlTable::report() takes it.
const char* number_of(const result::Diagnostic& problem) {
  return problem.code.c_str() + 1;
}

bool is_number(const ModelVariable& variable) {
  return variable.type != fmu::VariableType::Other;
}

bool is_whole(const ModelVariable& variable) {
  return variable.type != fmu::VariableType::Real && variable.type != fmu::VariableType::Float64 &&
         variable.type != fmu::VariableType::Float32;
}

// Names go into drawings and reports as they are.
bool is_plain(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_.[](),").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

class FmuTypeReader {
 public:
  FmuTypeReader(const TomlTable& table, const TypePlace& place) : table_(table), place_(place) {
    setup_->name = place.name;
    setup_->seed = place.options.seed;
    setup_->command.where = table.where("file");
  }

  std::optional<ComponentType> read() {
    const std::string file = table_.required_text("file");
    if (file.empty()) return std::nullopt;
    const std::filesystem::path path = place_.folder / file;
    auto opened = fmu::FmuFile::open(path);
    if (!opened) {
      for (const result::Diagnostic& problem : opened.error())
        report(table_, "file", place_of(problem.where) + problem.message, problem.hint, number_of(problem));
      return std::nullopt;
    }
    description_ = &opened->description();
    read_patience();
    check_step();
    const std::vector<std::pair<std::string, double>> parameters = read_parameters();
    read_faults();
    list_inputs();
    list_outputs();
    if (setup_->inputs.size() + setup_->outputs.size() > stepped::kMaxTerminals)
      report(table_, "file",
             "it has more than " + std::to_string(stepped::kMaxTerminals) + " inputs and outputs",
             "outputs = [\"level\"] takes some of them", "0335");
    if (wrong_) return std::nullopt;
    setup_->command.log = place_.options.log;
    setup_->command.arguments =
        fmu::fmu_call({path, place_.options.processes / place_.name, parameters}, place_.options.programs);
    type_.make = [setup = std::shared_ptr<const FmuSetup>(setup_)](const Parameters&) {
      return make_fmu_part(setup);
    };
    return std::move(type_);
  }

 private:
  void report(const TomlTable& table, const std::string& key, const std::string& message,
              const std::string& hint, const char* number) {
    wrong_ = true;
    table.report(key, message, hint, number);
  }
  // A place in a file inside of the FMU.
  static std::string place_of(const result::Location& where) {
    return where.line == 0 ? where.file + ": " : where.file + ":" + std::to_string(where.line) + ": ";
  }

  std::chrono::milliseconds patience(const char* key, const char* fallback) {
    const Quantity figure =
        read_figure(table_, {.name = key, .unit = "s", .fallback = fallback, .low = 1e-3, .high = 600.0},
                    place_.replaced);
    return std::chrono::milliseconds(std::llround(figure.value * 1e3));
  }
  void read_patience() {
    setup_->command.patience = patience("timeout", "1 s");
    setup_->command.beginning = patience("start_timeout", "30 s");
  }

  void check_step() {
    const double own = description_->fixed_step.value_or(0.0);
    if (own <= 0.0) return;
    const double steps = place_.step_s / own;
    if (std::round(steps) >= 1.0 && std::abs(steps - std::round(steps)) < 1e-6 * steps) return;
    report(table_, "file",
           "[plant] communication_step is no multiple of the FMU's own step of " + std::to_string(own) + " s",
           "communication_step = \"" + std::to_string(own) + " s\"", "0335");
  }

  const ModelVariable* find(const TomlTable& table, const std::string& key, VariableUse use) {
    const auto found = fmu::find_variables(*description_, {{key, use, {}}});
    if (found) return found->front();
    const result::Diagnostic& problem = found.error().front();
    report(table, key, problem.message, problem.hint, number_of(problem));
    return nullptr;
  }

  // What the file says of it holds where the FMU says nothing, or a pure number; else both must say the same.
  std::optional<Unit> find_unit(const ModelVariable& variable) {
    const TomlTable units = table_.table("units");
    const auto own = unit_of(*description_, variable);
    if (!units.has(variable.name)) return own;
    const std::string text = units.text(variable.name, {});
    const auto unit = parse_unit(text);
    if (!unit) {
      report(units, variable.name, "'" + text + "' is no unit", "such as \"m\", \"l/s\", \"percent\"",
             "0341");
    } else if (own && !own->dimension.none() && !same_measure(*own, *unit)) {
      report(units, variable.name,
             "the FMU has '" + variable.name + "' in '" + variable.unit + "', not in '" + text + "'",
             "leave it out: figures are converted from the FMU's own unit", "0341");
    }
    return unit;
  }
  std::optional<Unit> wanted_unit(const TomlTable& table, const std::string& key,
                                  const ModelVariable& variable) {
    auto unit = find_unit(variable);
    if (!unit)
      report(table, key, "the unit '" + variable.unit + "' of '" + variable.name + "' is not known",
             "units.\"" + variable.name + "\" = \"m\" says which one it is", "0341");
    return unit;
  }

  std::vector<std::pair<std::string, double>> read_parameters() {
    std::vector<std::pair<std::string, double>> parameters;
    const TomlTable list = table_.table("parameters");
    for (const std::string& key : list.keys()) {
      const ModelVariable* const variable = find(list, key, VariableUse::Parameter);
      if (variable == nullptr) continue;
      if (variable->type == fmu::VariableType::Boolean) {
        parameters.emplace_back(key, list.boolean(key, false) ? 1.0 : 0.0);
      } else if (const auto unit = wanted_unit(list, key, *variable)) {
        const Quantity figure = read_figure(list, {.name = key, .unit = unit->text}, place_.replaced);
        parameters.emplace_back(key, unit->from_si(figure.value));
      }
    }
    list.accept_all();  // what is none is told by then
    return parameters;
  }

  void read_faults() {
    const TomlTable list = table_.table("faults");
    for (const std::string& key : list.keys()) {
      taken_.insert(key);
      const ModelVariable* const variable = find(list, key, VariableUse::Fault);
      const std::vector<double> range = list.numbers(key);
      if (variable == nullptr) continue;
      const auto unit = wanted_unit(list, key, *variable);
      if (!unit) continue;
      if (range.size() != 2 || !(range[0] < range[1])) {
        report(list, key, "a fault has its least and its greatest value", key + " = [0.0, 0.5]", "0006");
        continue;
      }
      type_.faults.push_back({.name = key,
                              .unit = unit->text,
                              .low = range[0],
                              .high = range[1],
                              .rest = 0.0,
                              .meaning = variable->description,
                              .whole = is_whole(*variable)});
      setup_->faults.push_back(port_of(*variable, *unit));
    }
  }

  static FmuPort port_of(const ModelVariable& variable, const Unit& unit) {
    const bool is_switch = variable.type == fmu::VariableType::Boolean;
    return {variable.name, unit, is_switch ? variable.start : unit.to_si(variable.start), is_switch};
  }

  // Those that are joined, and the others, which keep their start.
  void list_inputs() {
    for (const std::string& key : table_.keys()) {
      if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
      const ModelVariable* const variable = find(table_, key, VariableUse::Actuator);
      if (variable == nullptr) continue;
      if (taken_.contains(key)) {
        report(table_, key, "'" + key + "' is a fault already", "what is joined is no fault", "0335");
      } else if (const auto unit = wanted_unit(table_, key, *variable)) {
        add_input(*variable, *unit);
      }
    }
    for (const ModelVariable& variable : description_->variables) {
      if (variable.causality != "input" || !is_number(variable) || !is_plain(variable.name)) continue;
      if (taken_.contains(variable.name) ||
          std::find(kKeys.begin(), kKeys.end(), variable.name) != kKeys.end())
        continue;
      if (const auto unit = find_unit(variable)) add_input(variable, *unit);
    }
  }
  void add_input(const ModelVariable& variable, const Unit& unit) {
    taken_.insert(variable.name);
    const FmuPort port = port_of(variable, unit);
    setup_->inputs.push_back(port);
    type_.ports.push_back({.name = port.name,
                           .kind = port.is_switch ? PortKind::Logic : PortKind::Signal,
                           .unit = unit.text,
                           .open = Open::Constant,
                           .constant = port.start,
                           .meaning = variable.description});
  }

  void list_outputs() {
    if (table_.has("outputs")) {
      for (const std::string& name : table_.texts("outputs")) {
        const auto found = fmu::find_variables(*description_, {{name, VariableUse::Sensor, {}}});
        if (found) {
          add_output("outputs", *found->front());
        } else {
          const result::Diagnostic& problem = found.error().front();
          report(table_, "outputs", problem.message, problem.hint, number_of(problem));
        }
      }
      return;
    }
    for (const ModelVariable& variable : description_->variables)
      if (variable.causality == "output" && is_number(variable) && is_plain(variable.name))
        add_output("file", variable);
  }
  void add_output(const char* key, const ModelVariable& variable) {
    if (!is_plain(variable.name) || !taken_.insert(variable.name).second) {
      report(table_, key, "'" + variable.name + "' cannot be the name of an output",
             "letters, digits, '_', '.', brackets and commas, and each once", "0335");
      return;
    }
    const auto unit = wanted_unit(table_, key, variable);
    if (!unit) return;
    const FmuPort port = port_of(variable, *unit);
    setup_->outputs.push_back(port);
    type_.ports.push_back({.name = port.name,
                           .kind = port.is_switch ? PortKind::Logic : PortKind::Signal,
                           .role = Role::Node,
                           .unit = unit->text,
                           .open = Open::Fine,
                           .meaning = variable.description});
  }

  const TomlTable& table_;
  const TypePlace& place_;
  const fmu::ModelDescription* description_ = nullptr;
  std::shared_ptr<FmuSetup> setup_ = std::make_shared<FmuSetup>();  // shared with the type
  ComponentType type_ = {.name = "fmu", .meaning = "a Functional Mock-up Unit"};
  std::set<std::string> taken_;
  bool wrong_ = false;
};

}  // namespace

ComponentType fmu_type() {
  return {.name = "fmu",
          .meaning =
              "a Functional Mock-up Unit (file = \"...\"), whose inputs and outputs are its ports; a process",
          .of_file = [](const TomlTable& table, const TypePlace& place) {
            return FmuTypeReader(table, place).read();
          }};
}

}  // namespace stepwright::components::library
