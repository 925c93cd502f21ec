#include "plant_models/fmu/model_description.h"

#include <algorithm>
#include <array>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "plant_models/fmu/array_variable.h"

namespace stepwright::fmu {
namespace {

constexpr std::size_t kMostVariables = 200'000;
constexpr std::size_t kMostUnits = 10'000;
constexpr std::size_t kMostMistakes = 20;

constexpr std::array<std::pair<const char*, VariableType>, 14> kTypes = {
    {{"Real", VariableType::Real},
     {"Integer", VariableType::Integer},
     {"Enumeration", VariableType::Enumeration},
     {"Boolean", VariableType::Boolean},
     {"Float64", VariableType::Float64},
     {"Float32", VariableType::Float32},
     {"Int8", VariableType::Int8},
     {"UInt8", VariableType::UInt8},
     {"Int16", VariableType::Int16},
     {"UInt16", VariableType::UInt16},
     {"Int32", VariableType::Int32},
     {"UInt32", VariableType::UInt32},
     {"Int64", VariableType::Int64},
     {"UInt64", VariableType::UInt64}}};

std::optional<VariableType> type_of(std::string_view name) {
  for (const auto& [word, type] : kTypes)
    if (name == word) return type;
  return std::nullopt;
}

class Reader {
 public:
  Reader(std::string_view xml, const std::string& name) : xml_(xml), name_(name) {}

  result::Result<ModelDescription> read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(xml_.data(), xml_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      complain(parsed.offset, std::string("this is no well-formed XML: ") + parsed.description());
      return tl::unexpected(std::move(mistakes_));
    }
    const pugi::xml_node root = document.document_element();
    if (std::string_view(root.name()) != "fmiModelDescription") {
      complain(root.offset_debug(), "the root is <" + std::string(root.name()) + ">",
               "an FMU has <fmiModelDescription>");
      return tl::unexpected(std::move(mistakes_));
    }
    read_root(root);
    read_units(root.child("UnitDefinitions"));
    read_types(root.child("TypeDefinitions"));
    const pugi::xml_node variables = root.child("ModelVariables");
    read_sizes(variables);
    for (const pugi::xml_node variable : variables.children()) {
      if (variable.type() != pugi::node_element || mistakes_.size() >= kMostMistakes) continue;
      if (!read_variable(variable)) {
        complain(variable.offset_debug(), "more than " + std::to_string(kMostVariables) + " variables");
        break;
      }
    }
    if (!mistakes_.empty()) return tl::unexpected(std::move(mistakes_));
    return std::move(found_);
  }

 private:
  void complain(std::ptrdiff_t offset, std::string message, std::string hint = {}) {
    mistakes_.push_back(
        {"C0332", result::Severity::Error, {name_, line_of(offset), 0}, std::move(message), std::move(hint)});
  }

  // Elements come in the order of the file: counted once.
  std::uint32_t line_of(std::ptrdiff_t offset) {
    const auto end = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), xml_.size());
    if (end < counted_) {
      counted_ = 0;
      line_ = 1;
    }
    line_ += static_cast<std::uint32_t>(std::count(xml_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                                   xml_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    counted_ = end;
    return line_;
  }

  void read_root(pugi::xml_node root) {
    const std::string version = root.attribute("fmiVersion").value();
    if (version.starts_with("3.")) {
      found_.version = FmiVersion::V3;
    } else if (version != "2.0") {
      complain(root.offset_debug(), "fmiVersion is '" + version + "'", "2.0 and 3.0 are read");
    }
    found_.name = root.attribute("modelName").value();
    const char* const token = found_.version == FmiVersion::V2 ? "guid" : "instantiationToken";
    found_.token = root.attribute(token).value();
    if (found_.token.empty()) complain(root.offset_debug(), std::string("there is no ") + token);
    const pugi::xml_node cosimulation = root.child("CoSimulation");
    if (!cosimulation) {
      complain(root.offset_debug(), "this FMU is no co-simulation",
               "export it for co-simulation: a model exchange has no solver of its own");
      return;
    }
    found_.identifier = cosimulation.attribute("modelIdentifier").value();
    found_.needs_tool = cosimulation.attribute("needsExecutionTool").as_bool();
    found_.variable_steps = cosimulation.attribute("canHandleVariableCommunicationStepSize").as_bool();
    if (const auto step = cosimulation.attribute("fixedInternalStepSize"))
      found_.fixed_step = step.as_double();
    const bool plain = std::all_of(found_.identifier.begin(), found_.identifier.end(),
                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    if (found_.identifier.empty() || !plain || found_.identifier.size() > 200)
      complain(cosimulation.offset_debug(),
               "modelIdentifier '" + found_.identifier.substr(0, 80) + "' is no name in C");
    if (found_.needs_tool)
      complain(cosimulation.offset_debug(), "this FMU needs the tool that it comes from",
               "export it with its solver (needsExecutionTool = \"false\")");
  }

  void read_units(pugi::xml_node list) {
    for (const pugi::xml_node unit : list.children("Unit")) {
      const pugi::xml_node base = unit.child("BaseUnit");
      if (!base || found_.units.size() >= kMostUnits) continue;
      UnitDefinition definition{.name = unit.attribute("name").value(),
                                .factor = base.attribute("factor").as_double(1.0),
                                .offset = base.attribute("offset").as_double(0.0)};
      for (std::size_t i = 0; i < UnitDefinition::kBases.size(); ++i)
        definition.exponents[i] = base.attribute(UnitDefinition::kBases[i]).as_int();
      definition.other = base.attribute("mol").as_int() != 0 || base.attribute("cd").as_int() != 0;
      found_.units.push_back(std::move(definition));
    }
  }

  // Units of types that variables are declared by: FMI 2 has <SimpleType><Real unit>, FMI 3 <Float64Type
  // unit>.
  void read_types(pugi::xml_node list) {
    for (const pugi::xml_node type : list.children()) {
      const pugi::xml_node real = found_.version == FmiVersion::V2 ? type.child("Real") : type;
      if (const pugi::xml_attribute unit = real.attribute("unit"))
        unit_of_type_.emplace(type.attribute("name").value(), unit.value());
    }
  }

  // What the dimensions of arrays may refer to: structural parameters, at their start.
  void read_sizes(pugi::xml_node list) {
    for (const pugi::xml_node node : list.children()) {
      if (std::string_view(node.attribute("causality").value()) == "structuralParameter")
        sizes_.emplace(node.attribute("valueReference").as_uint(), node.attribute("start").as_ullong());
    }
  }

  // Nothing if it has no dimensions, or wrong ones, which are reported.
  std::optional<std::vector<std::uint64_t>> read_dimensions(pugi::xml_node node) {
    std::vector<std::uint64_t> dimensions;
    for (const pugi::xml_node dimension : node.children("Dimension")) {
      const auto size = sizes_.find(dimension.attribute("valueReference").as_uint());
      if (const pugi::xml_attribute start = dimension.attribute("start")) {
        dimensions.push_back(start.as_ullong());
      } else if (dimension.attribute("valueReference") && size != sizes_.end()) {
        dimensions.push_back(size->second);
      } else {
        complain(dimension.offset_debug(), "a dimension without a size",
                 "start = \"3\", or the valueReference of a structural parameter");
        return std::nullopt;
      }
    }
    return dimensions.empty() ? std::nullopt : std::optional(dimensions);
  }

  // False if there are too many.
  bool append(const ModelVariable& variable, pugi::xml_node node,
              const std::optional<std::vector<std::uint64_t>>& dimensions,
              const std::vector<double>& starts) {
    const std::size_t room = kMostVariables - found_.variables.size();
    const auto count = dimensions ? count_elements(*dimensions, room) : 1;
    if (!count || *count > room) return false;
    if (!dimensions) {
      found_.variables.push_back(variable);
    } else if (starts.size() > 1 && starts.size() != *count) {
      complain(node.offset_debug(), "'" + variable.name + "' has " + std::to_string(*count) +
                                        " elements, but " + std::to_string(starts.size()) + " start values");
    } else {
      append_elements(variable, *dimensions, starts, found_.variables);
    }
    return true;
  }

  // False if there are too many.
  bool read_variable(pugi::xml_node node) {
    ModelVariable variable;
    pugi::xml_node typed = node;
    if (found_.version == FmiVersion::V2) {
      typed = node.find_child([](pugi::xml_node child) {
        return type_of(child.name()) || std::string_view(child.name()) == "String";
      });
    }
    variable.name = node.attribute("name").value();
    variable.line = line_of(node.offset_debug());
    variable.type = type_of(typed.name()).value_or(VariableType::Other);
    variable.causality = node.attribute("causality").as_string("local");
    variable.variability = node.attribute("variability").value();
    variable.description = node.attribute("description").value();
    variable.unit = typed.attribute("unit").value();
    const auto declared = unit_of_type_.find(typed.attribute("declaredType").value());
    if (variable.unit.empty() && declared != unit_of_type_.end()) variable.unit = declared->second;
    const std::vector<double> starts = numbers_of(typed.attribute("start").value());
    if (!starts.empty()) variable.start = starts.front();
    const pugi::xml_attribute reference = node.attribute("valueReference");
    if (variable.name.empty() || !reference) {
      complain(node.offset_debug(), "a variable without a name or without a value reference");
      return true;
    }
    variable.reference = reference.as_uint();
    const auto dimensions = read_dimensions(node);
    if (!append(variable, node, dimensions, starts)) return false;
    for (const pugi::xml_node alias : node.children("Alias")) {
      variable.name = alias.attribute("name").value();
      if (!variable.name.empty() && !append(variable, node, dimensions, starts)) return false;
    }
    return true;
  }

  std::string_view xml_;
  const std::string& name_;
  ModelDescription found_;
  std::map<std::string, std::string> unit_of_type_;
  std::map<std::uint32_t, std::uint64_t> sizes_;  // by the value reference of a structural parameter
  result::Diagnostics mistakes_;
  std::size_t counted_ = 0;
  std::uint32_t line_ = 1;
};

}  // namespace

const ModelVariable* ModelDescription::find(std::string_view variable) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const ModelVariable& each) { return each.name == variable; });
  return found == variables.end() ? nullptr : &*found;
}

const UnitDefinition* ModelDescription::find_unit(std::string_view unit) const {
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const UnitDefinition& each) { return each.name == unit; });
  return found == units.end() ? nullptr : &*found;
}

result::Result<ModelDescription> parse_description(std::string_view xml, const std::string& name) {
  return Reader(xml, name).read();
}

}  // namespace stepwright::fmu
