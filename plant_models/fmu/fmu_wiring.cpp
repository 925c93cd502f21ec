#include "plant_models/fmu/fmu_wiring.h"

#include <iterator>
#include <utility>

#include "runtime/ground/result/closest.h"

namespace stepwright::fmu {
namespace {

// Why it cannot be used so; empty if it can.
std::string refusal(const ModelVariable& variable, VariableUse use) {
  if (variable.type == VariableType::Other) return "it is no number and no Boolean";
  const bool input = variable.causality == "input";
  const bool parameter = variable.causality == "parameter";
  switch (use) {
    case VariableUse::Actuator:
      return input ? "" : "its causality is '" + variable.causality + "': an actuator is an input";
    case VariableUse::Sensor:
      return {};
    case VariableUse::Fault:
      if (input || (parameter && variable.variability == "tunable")) return {};
      return "a fault is an input or a tunable parameter; its causality is '" + variable.causality +
             "', its variability '" + variable.variability + "'";
    case VariableUse::Parameter:
      if (input || parameter) return {};
      return "its causality is '" + variable.causality + "': it is no parameter";
  }
  return {};
}

std::string hint_of(const ModelDescription& description, const std::string& name) {
  std::vector<std::string> names;
  for (const ModelVariable& each : description.variables) names.push_back(each.name);
  const std::string* const meant = result::closest(name, names, 3);
  if (meant != nullptr) return "did you mean '" + *meant + "'?";
  std::string list;
  for (const ModelVariable& each : description.variables) {
    if (each.causality != "input" && each.causality != "output") continue;
    if (list.size() > 200) {
      list += ", ...";
      break;
    }
    list += (list.empty() ? "" : ", ") + each.name;
  }
  return list.empty() ? "it has no inputs and outputs" : "its inputs and outputs: " + list;
}

}  // namespace

result::Result<std::vector<const ModelVariable*>> find_variables(const ModelDescription& description,
                                                                 const std::vector<WantedVariable>& wanted) {
  std::vector<const ModelVariable*> found;
  result::Diagnostics problems;
  const auto complain = [&problems](const WantedVariable& each, std::string message, std::string hint) {
    problems.push_back({"C0335", result::Severity::Error, each.where, std::move(message), std::move(hint)});
  };
  for (const WantedVariable& each : wanted) {
    const ModelVariable* const variable = description.find(each.name);
    found.push_back(variable);
    if (variable == nullptr) {
      complain(each, "the FMU has no variable '" + each.name + "'", hint_of(description, each.name));
    } else if (const std::string why = refusal(*variable, each.use); !why.empty()) {
      complain(each, "variable '" + each.name + "' of the FMU cannot be used so: " + why,
               "line " + std::to_string(variable->line) + " of its modelDescription.xml");
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return found;
}

}  // namespace stepwright::fmu
