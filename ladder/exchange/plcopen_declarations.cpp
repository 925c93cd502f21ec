// Data types, initial values and variables of PLCopen TC6 XML as ST text.

#include <algorithm>
#include <array>

#include "ladder/exchange/plcopen_read.h"
#include "ladder/graphic/identifier.h"

namespace stepwright::exchange::plcopen {
namespace {

namespace code = source::code;

pugi::xml_node first_element(pugi::xml_node node) {
  for (const pugi::xml_node each : node.children())
    if (each.type() == pugi::node_element) return each;
  return {};
}

std::string array_type(ReadContext& context, pugi::xml_node array) {
  std::string bounds;
  for (const pugi::xml_node each : array.children()) {
    if (local_name(each) != "dimension") continue;
    bounds += (bounds.empty() ? "" : ", ") + context.required(each, "lower") + ".." +
              context.required(each, "upper");
  }
  return "ARRAY[" + bounds + "] OF " + read_type(context, child(array, "baseType"));
}

std::string enumeration_type(ReadContext& context, pugi::xml_node enumeration) {
  std::string values;
  for (const pugi::xml_node each : child(enumeration, "values").children()) {
    if (local_name(each) != "value") continue;
    values += (values.empty() ? "" : ", ") + context.required(each, "name");
    if (const pugi::xml_attribute value = each.attribute("value"))
      values += std::string(" := ") + value.value();
  }
  const pugi::xml_node base = child(enumeration, "baseType");
  return (base ? read_type(context, base) + " " : "") + "(" + values + ")";
}

std::string structure_type(ReadContext& context, pugi::xml_node structure) {
  std::string text = "STRUCT ";
  for (const pugi::xml_node each : structure.children()) {
    if (local_name(each) != "variable") continue;
    const std::string type = read_type(context, child(each, "type"));
    text += context.required(each, "name");
    if (const pugi::xml_attribute address = each.attribute("address"))
      text += std::string(" AT ") + address.value();
    text += " : " + type;
    const std::string value = read_value(context, child(each, "initialValue"), type);
    if (!value.empty()) text += " := " + value;
    text += "; ";
  }
  return text + "END_STRUCT";
}

std::string subrange_type(ReadContext& context, pugi::xml_node subrange) {
  const pugi::xml_node range = child(subrange, "range");
  return read_type(context, child(subrange, "baseType")) + "(" + context.required(range, "lower") + ".." +
         context.required(range, "upper") + ")";
}

// Editors leave the quotes of string literals out.
std::string quoted(const std::string& value, const std::string& type) {
  const std::string name = graphic::upper(type);
  const bool wide = name.rfind("WSTRING", 0) == 0;
  if ((!wide && name.rfind("STRING", 0) != 0) || value.empty()) return value;
  if (value[0] == '\'' || value[0] == '"' || value.find('#') != std::string::npos) return value;
  return wide ? "\"" + value + "\"" : "'" + value + "'";
}

std::string element_type(const std::string& type) {
  const std::size_t of = graphic::upper(type).rfind(" OF ");
  return of == std::string::npos ? "" : type.substr(of + 4);
}

}  // namespace

std::string read_type(ReadContext& context, pugi::xml_node node) {
  const pugi::xml_node type = first_element(node);
  const std::string name(local_name(type));
  if (!type) {
    context.error(node, code::kNotPlcopen, "a type is missing", "name one, such as <BOOL/>");
    return "BOOL";
  }
  if (name == "array") return array_type(context, type);
  if (name == "derived") return context.required(type, "name");
  if (name == "enum") return enumeration_type(context, type);
  if (name == "struct") return structure_type(context, type);
  if (name == "subrangeSigned" || name == "subrangeUnsigned") return subrange_type(context, type);
  if (name == "pointer") return "REF_TO " + read_type(context, child(type, "baseType"));
  const std::string upper = graphic::upper(name);
  if (upper == "STRING" || upper == "WSTRING") {
    const pugi::xml_attribute length = type.attribute("length");
    return length ? upper + "[" + length.value() + "]" : upper;
  }
  return upper;
}

std::string read_value(ReadContext& context, pugi::xml_node node, const std::string& type) {
  const pugi::xml_node value = first_element(node);
  const std::string_view name = local_name(value);
  if (!value) return {};
  if (name == "simpleValue") return quoted(value.attribute("value").value(), context.type_behind(type));
  std::string text;
  const bool array = name == "arrayValue";
  for (const pugi::xml_node each : value.children()) {
    if (local_name(each) != "value") continue;
    if (!text.empty()) text += ", ";
    const std::string part = read_value(context, each, array ? element_type(type) : "");
    const std::string repetition = each.attribute("repetitionValue").value();
    if (!array) text += context.required(each, "member") + " := ";
    text += array && !repetition.empty() && repetition != "1" ? repetition + "(" + part + ")" : part;
  }
  return array ? "[" + text + "]" : "(" + text + ")";
}

void read_variables(ReadContext& context, pugi::xml_node list, graphic::VariableSection section,
                    std::vector<graphic::Variable>& variables, std::vector<graphic::VariableList>& lists) {
  lists.push_back(
      {context.documentation(list), extra_of(list, {"constant", "retain"}, {"variable", "documentation"})});
  for (const pugi::xml_node node : list.children()) {
    if (local_name(node) != "variable") continue;
    graphic::Variable variable;
    variable.name = context.required(node, "name");
    variable.type = read_type(context, child(node, "type"));
    variable.section = section;
    variable.address = node.attribute("address").value();
    variable.initial = read_value(context, child(node, "initialValue"), variable.type);
    variable.constant = context.boolean(list, "constant");
    variable.retain = context.boolean(list, "retain");
    variable.comment = context.documentation(node);
    variable.list = static_cast<std::uint32_t>(lists.size());
    variable.extra = extra_of(node, {"name", "address"}, {"type", "initialValue", "documentation"});
    variable.where = context.file().offset(node);
    variables.push_back(std::move(variable));
  }
}

}  // namespace stepwright::exchange::plcopen
